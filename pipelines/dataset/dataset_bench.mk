# Measures how many samples a core makes in an hour: configs/datasets/press_64.yaml from nothing to packed. Nothing else
# should run at the same time.

DATASET_BENCH := $(OUT)/dataset-bench
.PHONY: bench-dataset
bench-dataset: ## development: Sixty-four presses at the paper's resolution from nothing to packed, timed (ten minutes); writes OUT/docs/dataset_performance.md
bench-dataset: | build
	rm -rf $(DATASET_BENCH)
	mkdir -p $(DATASET_BENCH)
	cut -d ' ' -f 1 /proc/loadavg > $(DATASET_BENCH)/load
	date +%s > $(DATASET_BENCH)/began
	$(MAKE) -f Makefile.data --no-print-directory dataset CONFIG=configs/datasets/press_64.yaml OUT=$(DATASET_BENCH) REBUILD=no
	date +%s > $(DATASET_BENCH)/ended
	OPENBLAS_NUM_THREADS=1 $(BIN)/tabulate --out $(DATASET_BENCH)/cost --threads 1 --config configs/studies/speed/costs_press_64.yaml \
	  --timings $$(find $(DATASET_BENCH) -name '*.timings.yaml' | LC_ALL=C sort)
	$(MAKE) -f Makefile.data --no-print-directory bench-dataset-choices REBUILD=no
	@mkdir -p $(DOCS)
	bash pipelines/dataset/dataset_bench.sh $(DATASET_BENCH) $(JOBS) $(BIN)/tacipc > $(DOCS)/dataset_performance.md
	@cat $(DOCS)/dataset_performance.md

# Influence of its settings: the first sample with friction lagged once, and its last frame in default and in converged
# light.
BENCH_SAMPLE := $(DATASET_BENCH)/datasets/press_64/samples/000/mctac__dots__press__000000
BENCH_CHOICES := $(DATASET_BENCH)/choices
BENCH_GEL := $(DATASET_BENCH)/datasets/press_64/gels/mctac-adaptive_0100um/gel.msh
bench_render = --sensor configs/sensors/mctac.yaml --gel $(BENCH_GEL) --press $(BENCH_SAMPLE)/press --config
.PHONY: bench-dataset-choices
bench-dataset-choices: $(BENCH_CHOICES)/once/press.yaml $(BENCH_CHOICES)/metrics_default/metrics.yaml $(BENCH_CHOICES)/metrics_many_frames/metrics.yaml
$(BENCH_CHOICES)/once.yaml: configs/press/default.yaml
	mkdir -p $(@D)
	$(BIN)/tacipc set $< friction.lag=once > $@
$(BENCH_CHOICES)/once/press.yaml: $(BENCH_CHOICES)/once.yaml
	$(call run,press,--object $(DATASET_BENCH)/datasets/press_64/objects/dots/object.ply --object-config configs/objects/embossed.yaml \
	  --gel $(BENCH_GEL) --sensor configs/sensors/mctac.yaml --sample $(BENCH_SAMPLE)/sample.yaml --config $<)
$(BENCH_CHOICES)/%/render.yaml: configs/render/%.yaml
	$(call run,render,$(bench_render) $<)
$(BENCH_CHOICES)/converged.yaml: configs/render/default.yaml
	mkdir -p $(@D)
	$(BIN)/tacipc set $< subpixels=4 led_samples=8 > $@
$(BENCH_CHOICES)/converged/render.yaml: $(BENCH_CHOICES)/converged.yaml
	$(call run,render,$(bench_render) $<)
$(BENCH_CHOICES)/metrics_%/metrics.yaml: $(BENCH_CHOICES)/%/render.yaml $(BENCH_CHOICES)/converged/render.yaml
	$(call run,metrics,--config configs/metrics/images.yaml --images $(BENCH_CHOICES)/$*/frame_0005/tactile.png \
	  --reference $(BENCH_CHOICES)/converged/frame_0005/tactile.png)
