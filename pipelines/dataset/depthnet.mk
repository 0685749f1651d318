# Network that estimates depth from tactile images, trained on a packed dataset and evaluated on its test objects: make
# -f Makefile.data depthnet CONFIG=configs/datasets/mini.yaml [NET=default]
# With NET=outcome, or any with `task: outcome`, networks that predict the outcome of grasps.
$(call uses,dataset/pack)

NET ?= default#        depthnet: a file of configs/depthnet, or a path
override NET := $(strip $(NET))
packages_for_depthnet := depthnet predict

.PHONY: depthnet
ifeq ($(and $(DATASET_DIR),$(filter depthnet,$(MAKECMDGOALS))),)
depthnet:
	@echo "$@: say which dataset: make -f Makefile.data $@ CONFIG=configs/datasets/mini.yaml" >&2; exit 2
else
$(foreach v,DATASET_DIR NET,$(call check_name,$(v)))
DEPTHNET_CONFIG := $(firstword $(wildcard configs/depthnet/$(NET).yaml $(NET)))
ifeq ($(DEPTHNET_CONFIG),)
  $(error NET: there is no $(if $(filter %.yaml,$(NET)),,configs/depthnet/$(NET).yaml and no )$(NET))
endif
DEPTHNET_TASK := $(or $(shell sed -n 's/^task: *\([a-z]*\).*/\1/p' '$(DEPTHNET_CONFIG)'),depth)
DEPTHNET_LIST := $(DATASET_DIR)/shards/shards.txt
ifeq ($(wildcard $(DATASET_DIR)/pack/card.yaml),)
  $(error depthnet: $(DATASET_DIR) has not been packed; the goal dataset makes and packs it)
endif
ifeq ($(findstring test-,$(file < $(DEPTHNET_LIST))),)
  $(error depthnet: $(DATASET_DIR) has no objects to judge by: give it splits, such as {val: 0.1, test: 0.2})
endif
DEPTHNET := $(DATASET_DIR)/depthnet/$(basename $(notdir $(NET)))
DEPTHNET_SHARDS := $(DEPTHNET_LIST) $(wildcard $(DATASET_DIR)/shards/*/pack.yaml)
# A changed network file under the same name counts as another network, regardless of the file's age.
$(DEPTHNET)/net.choice: FORCE
	$(call replace_if_changed_by,cksum $(DEPTHNET_CONFIG))
$(DEPTHNET)/depthnet.yaml: $(DEPTHNET_CONFIG) $(DEPTHNET)/net.choice $(DEPTHNET_SHARDS) | build
	$(depthnet_is_built)
	$(call depthnet_run,--config $<)
$(DEPTHNET)/test/depthnet.yaml: $(DEPTHNET)/depthnet.yaml $(DEPTHNET_SHARDS)
	$(call depthnet_run,--model $(DEPTHNET)/model_*.onnx)
# The training uses all cores, so nothing else should run meanwhile.
depthnet_run = OPENBLAS_NUM_THREADS=1 $(BIN)/depthnet --out $(@D) --threads $(JOBS) $(1) --shards $(DEPTHNET_LIST)

depthnet: ## datasets: A network that reads depth, trained on a packed dataset and judged on its test objects; of grasps NET=outcome: CONFIG= [NET=default]
depthnet: $(DEPTHNET)/$(if $(filter depth,$(DEPTHNET_TASK)),test/)depthnet.yaml
	$(depthnet_says_$(DEPTHNET_TASK))
define depthnet_says_depth
@echo; $(BIN)/tacipc get $< summary.pressed.mae_mm.mean | sed 's/$$/ mm: mean error in contact on the test objects/'
@echo "Look at $(DEPTHNET)/test/sheet.png; the network is $(DEPTHNET)/model_*.onnx, and model.pt for PyTorch"
endef
define depthnet_says_outcome
@echo; for who in network shuffled; do $(BIN)/tacipc get $< summary.$$who.accuracy.mean | \
  sed "s/$$/: accuracy on the test objects, $$who, mean of the seeds/"; done
@$(BIN)/tacipc get $< summary.grip_only.accuracy | sed 's/$$/: of the force of the grip alone/'
@echo "Look at $(DEPTHNET)/outcome.md; the first seed's network is $(DEPTHNET)/model.pt"
endef
endif
