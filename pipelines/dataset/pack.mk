# Packs a made dataset into files for publication: make -f Makefile.data pack CONFIG=configs/datasets/mini.yaml
# [PACK=slim]
# Its samples are listed in $(DATASET_DIR)/plan/samples.csv; shards are written in parallel, one process each.
$(call uses,dataset/dataset)

CARD   ?= default#     a file of configs/datasets/card
FORMAT ?= webdataset#  repack: a file of configs/datasets/repack
CONFIG ?=#             the dataset's configuration, after which its folder is named; alternatively
DATASET_DIR ?= $(if $(strip $(CONFIG)),$(OUT)/datasets/$(basename $(notdir $(strip $(CONFIG)))))#  the dataset's folder
pack_planned = $(filter-out none,$(shell $(BIN)/tacipc get '$(strip $(DATASET_DIR))/plan/dataset.yaml' outputs.pack --default full 2> /dev/null))
PACK   ?= $(or $(pack_planned),full)# a file of configs/datasets/pack (default: from the dataset)
$(foreach v,CARD FORMAT DATASET_DIR PACK,$(eval override $(v) := $(patsubst %/,%,$(strip $($(v))))))

.PHONY: pack repack dataset-pack dataset-repack
SHARDS_DIR := $(DATASET_DIR)/shards

# Only one run packs or drops at a time: to be called in the shell of a recipe, which holds the lock until it and its
# processes end. Only then does make look at the work to do.
dataset_alone = { [ ! -d '$(DATASET_DIR)' ] || { exec 9> '$(DATASET_DIR)/.packing'; \
  flock -n 9 || { echo "$(1): waiting for another run that packs or drops" >&2; flock 9; }; }; }
make_again = env -u MAKEFLAGS -u MFLAGS -u MAKELEVEL $(MAKE) $(if $(findstring s,$(firstword -$(MAKEFLAGS))),-s) -f Makefile.data $(MAKEOVERRIDES) $(1)

ifeq ($(and $(DATASET_DIR),$(filter pack repack dataset-pack dataset-repack,$(MAKECMDGOALS))),)
pack repack dataset-pack dataset-repack:
	@echo "$@: say which dataset: make -f Makefile.data $@ CONFIG=configs/datasets/mini.yaml" >&2; exit 2
else
$(foreach v,DATASET_DIR PACK,$(call check_name,$(v)))
$(call check_writable,$(DATASET_DIR),.packing)
pack: | build ## datasets: A made dataset as HDF5 shards with tables, card and checksums: CONFIG= (or DATASET_DIR=) [PACK=slim]
	@$(call dataset_alone,$@) && $(call make_again,dataset-pack)
repack: | build ## datasets: Packed shards in another layout: CONFIG= FORMAT=webdataset|univtac|folder|lerobot
	@$(call dataset_alone,$@) && $(call make_again,dataset-repack)
endif

ifneq ($(and $(DATASET_DIR),$(filter dataset-pack dataset-repack,$(MAKECMDGOALS))),)
# PACK_SHARDS, and for each shard a file that changes if any of its packing inputs does: a sample that is made again
# causes its shard to be packed again.
ifneq ($(shell $(BIN)/survey pack-inputs '$(DATASET_DIR)' configs/datasets/pack/$(PACK).yaml && echo done),done)
  $(error pack: not possible)
endif
include $(SHARDS_DIR)/shards.mk

# A changed card counts as another dataset, regardless of the file's age.
$(SHARDS_DIR)/card.choice: FORCE
	@echo '$(CARD)' > $@.new-$$$$; cmp -s $@.new-$$$$ $@ && rm $@.new-$$$$ || mv $@.new-$$$$ $@

# Inputs of the packing, stored next to the record; without this file (or if it is older) they are unknown.
$(PACK_SHARDS:%=$(SHARDS_DIR)/%/pack.yaml): $(SHARDS_DIR)/%/pack.yaml: $(SHARDS_DIR)/%.inputs | build
	$(call run,pack,--config configs/datasets/pack/$(PACK).yaml --plan $(DATASET_DIR)/plan/samples.csv --dataset $(SHARDS_DIR)/dataset.yaml --shard $*)
	@cp $< $(@D)/packed.inputs || rm -f $(@D)/packed.inputs

SHARD_RECORDS := $(PACK_SHARDS:%=$(SHARDS_DIR)/%/pack.yaml)
$(DATASET_DIR)/pack/card.yaml: configs/datasets/card/$(CARD).yaml configs/datasets/card/loader.py configs/datasets/card/check_labels.py \
    $(SHARDS_DIR)/card.choice $(SHARDS_DIR)/shards.txt $(SHARD_RECORDS) | build
	$(call run,card,--name $(notdir $(DATASET_DIR)) --config $< --plan $(DATASET_DIR)/plan/samples.csv --dataset $(SHARDS_DIR)/dataset.yaml \
	  --shards $(SHARDS_DIR)/shards.txt --loader configs/datasets/card/loader.py --check-labels configs/datasets/card/check_labels.py \
	  $(if $(wildcard CITATION.cff),--citation CITATION.cff))

$(DATASET_DIR)/repack/$(FORMAT)/%/repack.yaml: configs/datasets/repack/$(FORMAT).yaml $(SHARDS_DIR)/%/pack.yaml | build
	$(call run,repack,--config $< --shard $(SHARDS_DIR)/$*/$*.h5)

dataset-pack: $(DATASET_DIR)/pack/card.yaml
	@echo; echo "Look at $(DATASET_DIR)/pack/README.md; that folder is what users download"
# Layouts of episodes: LeRobot counts them over the whole dataset, and the fingers of a grasp may be in two shards.
EPISODE_FORMATS := lerobot univtac
$(EPISODE_FORMATS:%=$(DATASET_DIR)/repack/%/repack.yaml): $(DATASET_DIR)/repack/%/repack.yaml: configs/datasets/repack/%.yaml $(SHARDS_DIR)/shards.txt \
    $(SHARD_RECORDS) | build
	$(call run,repack,--config $< --shards $(SHARDS_DIR)/shards.txt)

repacked := $(DATASET_DIR)/repack/$(FORMAT)
dataset-repack: $(if $(filter $(EPISODE_FORMATS),$(FORMAT)),$(repacked)/repack.yaml,$(PACK_SHARDS:%=$(repacked)/%/repack.yaml))
	@echo; echo "Look into $(DATASET_DIR)/repack/$(FORMAT)"
endif
