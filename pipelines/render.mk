# What rendering costs: frames of one press, tracing beside Embree's own rate, scene updates. Nothing else should run beside it.

.PHONY: build-bench-render bench-render bench-render-page
build-bench-render: build
	@cmake --build $(BUILD) --target bench_render -j $(JOBS) -- --quiet

# Measured anew at every call; the press is made once.
bench-render-page: $(OUT)/demo/letter_a/press/press.yaml | build-bench-render
	$(BIN)/bench_render --out $(OUT)/bench_render --threads 2 --sensor configs/sensors/mctac.yaml --gel $(OUT)/gels/mctac-adaptive_0100um/gel.msh --press $(OUT)/demo/letter_a/press
	cp $(OUT)/bench_render/render_performance.md docs/render_performance.md
	@cat docs/render_performance.md

bench-render: | build ## What rendering a frame costs, beside Embree's own rate (a minute after the demo's press); writes docs/render_performance.md
	@$(MAKE) -f Makefile.data --no-print-directory bench-render-page JOBS=1

# Straight light from point lights against POV-Ray's (Debian package povray, which nothing else needs).
.PHONY: build-render-check render-check render-check-page
build-render-check: build
	@cmake --build $(BUILD) --target render_check -j $(JOBS) -- --quiet

$(OUT)/render_check/render_check.yaml: $(OUT)/demo/letter_a/press/press.yaml configs/sensors/mctac.yaml | build-render-check
	$(call run,render_check,--sensor configs/sensors/mctac.yaml --gel $(OUT)/gels/mctac-adaptive_0100um/gel.msh --press $(OUT)/demo/letter_a/press)

# docs/render.md keeps its prose; the table between the marks is replaced.
render-check-page: $(OUT)/render_check/render_check.yaml
	cp $(OUT)/render_check/render_check.png docs/render_check.png
	sed -i -e '/^<!-- render_check -->/,/^<!-- end of render_check -->/{/^<!-- render_check -->/r $(OUT)/render_check/render_check.md' -e '/^<!--/!d}' docs/render.md
	@cat $(OUT)/render_check/render_check.md

render-check: render-check-page ## Our straight rendering against POV-Ray's (needs povray; seconds after the demo's press); writes the figure in docs/render.md
	$(call holds,$(OUT)/render_check/render_check.yaml)
