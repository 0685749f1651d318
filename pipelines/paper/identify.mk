# Identifies a sensor's mechanics from measured forces and marker vectors: make -f Makefile.data identify
# IDENTIFY=configs/studies/identify/gsmini_force.yaml
# The file lists the known, measured (below SHARED) and simulated data; docs/identify.md has the keys and results.
IDENTIFY ?= configs/studies/identify/gsmini_force.yaml#  file of the identification
override IDENTIFY := $(strip $(IDENTIFY))
identify_name := $(basename $(notdir $(IDENTIFY)))
IDENTIFIED := $(OUT)/identify/$(identify_name)
packages_for_identify := identify

.PHONY: identify
ifneq ($(filter identify,$(MAKECMDGOALS)),)
$(call check_name,IDENTIFY)
$(call check_name,SHARED)
ifeq ($(wildcard $(IDENTIFY)),)
  $(error IDENTIFY: $(IDENTIFY) does not exist)
endif
ifeq ($(wildcard $(SHARED)),)
  $(error SHARED: $(SHARED) does not exist; the measurements are looked for there)
endif

# Inputs of the stages are made from the single file first, then make restarts with its variables.
$(IDENTIFIED)/cases/cases.yaml: $(IDENTIFY) $(always) | build
	@[ -x $(BIN)/identify ] || { echo "identify: not built for want of libceres-dev: make -f Makefile.data packages build GROUPS=identify" >&2; exit 2; }
	$(call run,cases,--config $<)
$(IDENTIFIED)/cases/cases.mk: $(IDENTIFIED)/cases/cases.yaml ;
include $(IDENTIFIED)/cases/cases.mk
identify_tables := $(foreach m,$(IDENTIFY_MEASUREMENTS),$(addprefix $(SHARED)/,$(IDENTIFY_TABLES_$(m))))
identify_missing := $(filter-out $(wildcard $(identify_tables)),$(identify_tables))
ifneq ($(identify_missing),)
  $(error IDENTIFY: there is no $(identify_missing), which $(IDENTIFY) names)
endif

# Settings are only rewritten if they change: another prior does not repeat any press.
$(foreach f,$(IDENTIFY_RUNS:%=motion_%.yaml) $(IDENTIFY_MEASUREMENTS:%=%/indenter.yaml),\
  $(eval $(IDENTIFIED)/cases/$(f): $(IDENTIFIED)/cases/cases.yaml ;)\
  $(eval $(call changed_config,$(IDENTIFIED)/settings/$(f),$(IDENTIFIED)/cases/$(f),)))
$(eval $(call changed_config,$(IDENTIFIED)/settings/sensor.yaml,$(IDENTIFY_SENSOR),$(IDENTIFY_CHANGES)))
# Presses use the relaxed gel on a rigid mount; if friction has nodes, the press uses the friction of its node. The fit
# adds the other values.
identify_unpressed := mount mount_src material.relaxation material.relaxation_src $(if $(IDENTIFY_FRICTION_$(IDENTIFY_MIDDLE)),gel.friction gel.friction_src)
$(IDENTIFIED)/settings/rigid.yaml: $(IDENTIFIED)/settings/sensor.yaml | build
	$(BIN)/tacipc set $< $$(for key in $(identify_unpressed); do \
	  [ -z "$$($(BIN)/tacipc get $< $$key --default '')" ] || echo "-$$key"; done) > $@.new && mv $@.new $@
$(foreach n,$(IDENTIFY_NODES),$(eval $(call changed_config,$(IDENTIFIED)/settings/$(n)/sensor.yaml,$(IDENTIFIED)/settings/rigid.yaml,$(IDENTIFY_SET_$(n))))\
  $(eval $(call changed_config,$(IDENTIFIED)/settings/$(n)/press.yaml,$(IDENTIFY_PRESS),$(addprefix friction.coefficient=,$(IDENTIFY_FRICTION_$(n))))))

# $(call identify_gel,name,node,mesh)
define identify_gel
$(IDENTIFIED)/$(1)/tetmesh.yaml: $(IDENTIFIED)/settings/$(2)/sensor.yaml $(3) $(always) | build
	$$(call run,tetmesh,--sensor $$< --config $(3))
endef
$(foreach g,$(IDENTIFY_GELS),$(eval $(call identify_gel,$(g),$(IDENTIFY_FIRST_$(g)),$(IDENTIFY_MESH))))
define identify_indenter
$(IDENTIFIED)/indenters/$(1)/indenter.yaml: $(IDENTIFIED)/settings/$(1)/indenter.yaml $(addprefix $(SHARED)/,$(IDENTIFY_OBJECT_$(1))) $(always) | build
	$$(call run,indenter,--config $$< $(addprefix --mesh $(SHARED)/,$(IDENTIFY_OBJECT_$(1))))
endef
$(foreach m,$(IDENTIFY_MEASUREMENTS),$(eval $(call identify_indenter,$(m))))

# $(call identify_press,folder below runs,run,folder of the sensor below settings,gel,press configuration)
define identify_press
$(IDENTIFIED)/runs/$(1)/$(2)/press.yaml: $(IDENTIFIED)/indenters/$(IDENTIFY_MEASUREMENT_$(2))/indenter.yaml $(IDENTIFIED)/$(4)/tetmesh.yaml \
    $(IDENTIFIED)/settings/$(3)/sensor.yaml $(IDENTIFIED)/settings/motion_$(2).yaml $(5) $(always) | build
	$$(call run,press,--name $(1)_$(2) --object $(IDENTIFIED)/indenters/$(IDENTIFY_MEASUREMENT_$(2))/object.ply --object-config configs/objects/embossed.yaml \
	  --gel $(IDENTIFIED)/$(4)/gel.msh --sensor $(IDENTIFIED)/settings/$(3)/sensor.yaml --config $(5) --sample $(IDENTIFIED)/settings/motion_$(2).yaml \
	  --log-level warning)
endef
$(foreach n,$(IDENTIFY_NODES),$(foreach r,$(IDENTIFY_RUNS),\
  $(eval $(call identify_press,$(n),$(r),$(n),$(IDENTIFY_GEL_$(n)),$(IDENTIFIED)/settings/$(n)/press.yaml))))

# Checks: the middle node with another mesh or other numerics.
identify_checked := $(foreach r,$(IDENTIFY_RUNS),$(if $(IDENTIFY_CHECKED_$(r)),$(r)))
identify_friction := $(addprefix friction.coefficient=,$(IDENTIFY_FRICTION_$(IDENTIFY_MIDDLE)))
define identify_check
$(call changed_config,$(IDENTIFIED)/settings/$(1)/sensor.yaml,$(IDENTIFIED)/settings/$(IDENTIFY_MIDDLE)/sensor.yaml,$(IDENTIFY_CHECK_CHANGES_$(1)))
$(if $(IDENTIFY_CHECK_PRESS_$(1)),$(call changed_config,$(IDENTIFIED)/settings/$(1)/press.yaml,$(IDENTIFY_CHECK_PRESS_$(1)),$(identify_friction)))
$(if $(IDENTIFY_CHECK_MESH_$(1)),$(call identify_gel,gel_$(1),$(1),$(IDENTIFY_CHECK_MESH_$(1))))
endef
identify_check_gel = $(if $(IDENTIFY_CHECK_MESH_$(1)),gel_$(1),$(IDENTIFY_GEL_$(IDENTIFY_MIDDLE)))
identify_check_press = $(if $(IDENTIFY_CHECK_PRESS_$(1)),$(IDENTIFIED)/settings/$(1)/press.yaml,$(IDENTIFIED)/settings/$(IDENTIFY_MIDDLE)/press.yaml)
$(foreach c,$(IDENTIFY_CHECKS),$(eval $(call identify_check,$(c)))$(foreach r,$(identify_checked),\
  $(eval $(call identify_press,$(c),$(r),$(c),$(call identify_check_gel,$(c)),$(call identify_check_press,$(c))))))

identify_runs := $(foreach n,$(IDENTIFY_NODES),$(IDENTIFY_RUNS:%=$(n)/%)) $(foreach c,$(IDENTIFY_CHECKS),$(identify_checked:%=$(c)/%))
$(IDENTIFIED)/fit/identify.yaml: $(IDENTIFY) $(IDENTIFIED)/settings/sensor.yaml $(identify_runs:%=$(IDENTIFIED)/runs/%/press.yaml) \
    $(identify_tables) $(always) | build
	$(call run,identify,--config $(IDENTIFY) --sensor $(IDENTIFIED)/settings/sensor.yaml \
	  --measured $(foreach m,$(IDENTIFY_MEASUREMENTS),$(m)=$(SHARED)/$(IDENTIFY_FILE_$(m))) --runs $(foreach r,$(identify_runs),$(r)=$(IDENTIFIED)/runs/$(r)))

# docs/identify.md has marks for the shipped ones.
identify: ## own: A sensor's mechanics from measured forces and marker vectors: IDENTIFY=configs/studies/identify/gsmini_force.yaml (minutes)
identify: $(IDENTIFIED)/fit/identify.yaml
	@! grep -qsxF '<!-- $(identify_name) -->' docs/identify.md || [ $(IDENTIFY) != configs/studies/identify/$(identify_name).yaml ] \
	  || $(call fill_docs,identify.md,$(identify_name)=$(IDENTIFIED)/fit/table.md)
	@cat $(IDENTIFIED)/fit/table.md
	@echo; echo "Look at $(IDENTIFIED)/fit/*.svg; the sensor file is $(IDENTIFIED)/fit/sensor.yaml"
endif

# Sensor data sheet ("blind card"): CASES= lists the fitted and the compared data; each part has a target of its own.
.PHONY: blind-card
packages_for_blind-card := identify
ifneq ($(filter blind-card,$(MAKECMDGOALS)),)
$(call check_name,CASES)
CARD := $(OUT)/cards/$(basename $(notdir $(CASES)))
# $(call card_files,key): the files that the card names under a key, from here
card_files = $(shell for i in $$(seq 0 99); do file=$$($(BIN)/tacipc get '$(CASES)' "$(1)[$$i]" --default ''); \
  [ -z "$$file" ] || realpath -ms --relative-to=. "$(dir $(CASES))$$file"; done)
# $(call card_parts,key,flag,folder of the results,folder below each): flag name=folder … of the files under a key
card_part = $(basename $(notdir $(1)))
card_parts = $(if $(call card_files,$(1)),$(2) $(foreach f,$(call card_files,$(1)),$(call card_part,$(f))=$(OUT)/$(3)/$(call card_part,$(f))$(4)))
blind-card: ## own: Blind card of a sensor: what was fitted, on what, and predictions beside measurements: CASES=configs/studies/cards/gelsight_mini.yaml
blind-card: | build
	@[ "$$($(BIN)/tacipc get '$(CASES)' kind --default '')" = card ] \
	  || { echo 'blind-card: CASES: $(CASES) is no card (kind: card; there are $(wildcard configs/studies/cards/*.yaml))' >&2; exit 2; }
	$(foreach f,$(call card_files,mechanics),$(call make_again,REBUILD=no IDENTIFY=$(f) identify)$(newline)	)
	$(foreach f,$(call card_files,photographs),$(call make_again,REBUILD=no CASES=$(f) sim2real-page)$(newline)	)
	OPENBLAS_NUM_THREADS=1 $(BIN)/tabulate --out $(CARD) --threads $(THREADS) --config $(CASES) \
	  $(call card_parts,mechanics,--identified,identify,/fit) $(call card_parts,photographs,--compared,sim2real)
	@echo; echo "Look at $(CARD)/card.md; card.yaml has the same numbers"
endif
