# Fault injection in every stage: pipeline tests run with programs that are killed, lack disk space, and read damaged
# files (see faults.sh).

$(call uses,verification/stress)# for SEED

FAULTS ?= tiny_pipeline_test export_test track_test mpm_test pack_test layouts_test sim2real_test sensor_fit_test fots_test paper_markers_test \
  dataset_test clock_test# faults: tests whose stages are struck
override FAULTS := $(strip $(FAULTS))

FAULT_FOLDER  := $(OUT)/faults/$(SEED)
FAULT_RECORDS := $(FAULTS:%=$(FAULT_FOLDER)/%/faults.yaml)
packages_for_faults := tests
.PHONY: faults
$(FAULT_FOLDER)/%/faults.yaml: | build
	bash pipelines/verification/faults.sh $* $(BIN) $(SEED) $(@D)

faults: ## development: Every stage killed, out of room and given damaged files, at random times and places (SEED=1; finished tests are not run again)
faults: $(FAULT_RECORDS)
	@bash pipelines/verification/faults_table.sh $(FAULT_RECORDS)
