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
