# Scale test with very many samples: real stages on a gel of some 70 vertices and pictures of 16 x 12 pixels, one frame
# each, packed and reported.

SCALE_SAMPLES ?= 100000#  bench-scale: a multiple of ten
override SCALE_SAMPLES := $(strip $(SCALE_SAMPLES))
BENCH_SCALE := $(OUT)/scale-bench
.PHONY: bench-scale
$(eval $(call changed_config,$(BENCH_SCALE)/sensor.yaml,configs/sensors/mctac.yaml,camera.width_px=16 camera.height_px=12))
$(eval $(call changed_config,$(BENCH_SCALE)/gel.yaml,configs/gels/tiny.yaml,\
  sizing.centre_mm=4 sizing.inner_mm=5 sizing.rim_mm=7 sizing.back_mm=5 tetrahedra.min_dihedral_deg=8))
$(eval $(call changed_config,$(BENCH_SCALE)/decimate.yaml,configs/objects/decimate/default.yaml,target_vertices=300))
define bench_scale_yaml
seed: 1
sensors: {sensor: sensor.yaml, mesh: gel.yaml}
objects: {emboss: $(abspath configs/objects/patterns), only: [bricks, checker, dots, gear, hexagon, letter_a, rings, square, star, triangle]}
decimate: decimate.yaml
render: $(abspath configs/render/many_frames.yaml)
motions:
  - name: press
    samples: $(shell echo $$(($(SCALE_SAMPLES) / 10)))
    placement: {center_mm: {x: [-2, 2], y: [-2, 2]}, rotate_deg: [0, 360]}
    motion: {kind: press, depth_mm: [0.2, 0.4], steps: 1}
splits: {val: 0.1, test: 0.2}
maps: [tactile, indentation, contact]
outputs: {shard_mb: 100, pack: slim}
endef
$(BENCH_SCALE)/scale.yaml: FORCE
	$(call replace_if_changed,$(bench_scale_yaml))
bench-scale: ## development: 100,000 tiny samples from nothing to packed pages: files, memory and time of each step (hours; resumes) [SCALE_SAMPLES=]
bench-scale: $(addprefix $(BENCH_SCALE)/,scale.yaml sensor.yaml gel.yaml decimate.yaml) | build
	@# Some presses of so coarse a gel fail; the others are packed all the same.
	$(MAKE) -f Makefile.data --no-print-directory dataset CONFIG=$< OUT=$(BENCH_SCALE) REBUILD=no || [ -e $(BENCH_SCALE)/datasets/scale/pack/card.yaml ]
	$(MAKE) -f Makefile.data --no-print-directory dataset-report CONFIG=$< OUT=$(BENCH_SCALE) REBUILD=no
	bash pipelines/dataset/dataset_scale.sh $(BENCH_SCALE)/datasets/scale $(BIN)
