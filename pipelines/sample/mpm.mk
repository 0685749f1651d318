# One object in a gel of material points: the sample of pipelines/sample/sample.mk without friction, which MPM's grid
# lacks.
$(call uses,sample/sample)

MPM ?= legacy_mctac#  a file of configs/rivals/mpm
override MPM := $(strip $(MPM))

.PHONY: mpm-sample build-bench-mpm bench-mpm bench-mpm-page
ifdef OBJECT
ifeq ($(wildcard configs/rivals/mpm/$(MPM).yaml),)
  $(error MPM: there is no configs/rivals/mpm/$(MPM).yaml (there are: $(basename $(notdir $(wildcard configs/rivals/mpm/*.yaml)))))
endif
MPM_SAMPLE := $(SAMPLE)/mpm-$(MPM)
$(MPM_SAMPLE)/mpm.yaml: $(SAMPLE)/object/decimate.yaml $(SAMPLE)/object.yaml $(sample_spec) $(motion_paths) configs/sensors/$(SENSOR).yaml \
    configs/rivals/mpm/$(MPM).yaml $(SAMPLE)/choice.txt $(always) | build
	$(call run,mpm,--name $(NAME) --object $(SAMPLE)/object/object.ply --object-config $(SAMPLE)/object.yaml --sensor configs/sensors/$(SENSOR).yaml \
	  --config configs/rivals/mpm/$(MPM).yaml --sample $(sample_spec))

mpm-sample: ## own: An object with Tacchi's material points instead of press: OBJECT=path.stl [MPM=legacy|legacy_mctac|physical and the variables of sample]
mpm-sample: $(MPM_SAMPLE)/mpm.yaml
	@echo; echo "Look at $(MPM_SAMPLE)/frame_*/indentation.png"
else
mpm-sample:
	@echo "mpm-sample: say which object: make -f Makefile.data mpm-sample OBJECT=path.stl" >&2; exit 2
endif

# Cost of material points, compared with the memory bandwidth. Nothing else should run at the same time.
build-bench-mpm: build
	@$(call compile,$(BUILD),bench_mpm)

# The measurement is repeated at every call.
bench-mpm-page: $(OUT)/objects/star/decimate.yaml | build-bench-mpm
	$(BIN)/bench_mpm --out $(OUT)/bench_mpm --threads 2 --sensor configs/sensors/mctac.yaml --object $(OUT)/objects/star/object.ply \
	  --config configs/rivals/mpm/legacy_mctac.yaml --config configs/rivals/mpm/physical.yaml
	$(call to_docs,$(OUT)/bench_mpm/mpm_performance.md)

bench-mpm: | build ## development: Cost of material points, against the rate of memory (two minutes); writes OUT/docs/mpm_performance.md
	@$(MAKE) -f Makefile.data --no-print-directory bench-mpm-page JOBS=1
