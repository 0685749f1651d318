# Cost of rendering: frames of one press, tracing compared with Embree's own rate, scene updates. Nothing else should
# run at the same time.

.PHONY: build-bench-render bench-render bench-render-page
build-bench-render: build
	@$(call compile,$(BUILD),bench_render)

# The measurement is repeated at every call; the press is made once.
bench-render-page: $(OUT)/demo/letter_a/press/press.yaml | build-bench-render
	$(BIN)/bench_render --out $(OUT)/bench_render --threads 2 --sensor configs/sensors/mctac.yaml --gel $(OUT)/gels/mctac-adaptive_0100um/gel.msh \
	  --press $(OUT)/demo/letter_a/press
	$(call to_docs,$(OUT)/bench_render/render_performance.md)
	@cat $(DOCS)/render_performance.md

bench-render: ## development: Cost of rendering a frame, against Embree's own rate (a minute after the demo's press); writes OUT/docs/render_performance.md
bench-render: | build
	@$(MAKE) -f Makefile.data --no-print-directory bench-render-page JOBS=1

# Direct light from point lights compared with POV-Ray (Debian package povray, which nothing else needs).
packages_for_render-check := tests
.PHONY: build-render-check render-check render-check-page
build-render-check: with-tests # the program belongs to a test
	@$(call compile,$(BUILD),render_check)

$(OUT)/render_check/render_check.yaml: $(OUT)/demo/letter_a/press/press.yaml configs/sensors/mctac.yaml | build-render-check
	$(call run,render_check,--sensor configs/sensors/mctac.yaml --gel $(OUT)/gels/mctac-adaptive_0100um/gel.msh --press $(OUT)/demo/letter_a/press)

# docs/render.md keeps its prose; only the table between the marks is replaced.
render-check-page: $(OUT)/render_check/render_check.yaml
	$(call to_docs,$(OUT)/render_check/render_check.png)
	$(call fill_docs,render.md,render_check=$(OUT)/render_check/render_check.md)
	@cat $(OUT)/render_check/render_check.md

render-check: ## studies: Our straight rendering against POV-Ray's (needs povray; seconds after the demo's press); writes the figure in OUT/docs/render.md
render-check: render-check-page
	$(call holds,$(OUT)/render_check/render_check.yaml)
