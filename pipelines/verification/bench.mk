# Cost of a press: the same presses by the default route and by factorisation, over sizes of gel, objects and motions,
# with threads and in parallel. Every press has a folder; an interrupted benchmark resumes. Nothing else should run at
# the same time. The coin of the paper's release is also measured if SHARED has it.

BENCH := $(OUT)/bench
BENCH_GELS ?= 3k 12k 24k 50k 100k#     pressed gels
BENCH_SHEAR_GELS ?= 3k 12k 24k#        sheared gels
BENCH_DIRECT_GELS ?= 3k 12k 24k#       gels pressed with every system factorised
BENCH_OBJECTS := sphere coin weave
BENCH_RELEASED := $(if $(wildcard $(SHARED)/data/tacipc_release/objects/coin_5002.obj),coin_5002)#  pressed with the paper's stiffness
BENCH_SHEAR_OBJECTS ?= $(BENCH_OBJECTS)#  sheared objects
BENCH_DIRECT_OBJECTS ?= sphere coin#      objects compared with other routes and in other scenes
bench_config = $(BENCH)/configs/$(if $(filter shear,$(1)),press,$(1))_$(2).yaml
bench_sample = configs/$(if $(filter shear,$(1)),studies/speed/shear,motions/press_0500um).yaml
bench_object_config = $(if $(filter coin_5002,$(1)),configs/objects/printed_indenter.yaml,configs/objects/embossed.yaml)

.PHONY: build-bench
build-bench: build
	@$(call compile,$(BUILD),bench_object bench_table routes_table defaults_table)

# Gels: the paper's mesh with its lengths scaled.
BENCH_SCALE_3k   := 2.2
BENCH_SCALE_12k  := 1.3
BENCH_SCALE_24k  := 1
BENCH_SCALE_50k  := 0.74
BENCH_SCALE_100k := 0.56
bench_lengths := sizing.centre_mm sizing.inner_mm sizing.rim_mm sizing.back_mm
bench_scaled = paste <(printf '%s\n' $(bench_lengths)) <($(BIN)/tacipc get $(1) $(bench_lengths)) | LC_ALL=C awk '{ printf "%s=%g\n", $$1, $$2 * $(2) }'
$(BENCH)/configs/gel_%.yaml: configs/gels/adaptive_0100um.yaml FORCE | build
	$(if $(BENCH_SCALE_$*),,$(error BENCH_GELS: there is no BENCH_SCALE_$*))
	$(call replace_if_changed_by,$(BIN)/tacipc set $< $$($(call bench_scaled,$<,$(BENCH_SCALE_$*))))
$(BENCH)/gels/%/tetmesh.yaml: $(BENCH)/configs/gel_%.yaml configs/sensors/mctac.yaml | build
	$(call run,tetmesh,--sensor configs/sensors/mctac.yaml --config $<)

# Settings: changes of configs/studies/speed/press.yaml by scene and by route of the solver.
BENCH_SCENE_press   :=
BENCH_SCENE_settled := friction.lag=iterated# until friction is consistent with its own contact forces
BENCH_SCENE_stiff   := barrier.stiffness=1.0e6# [paper] the coin of its release has walls too sharp for a tenth of it
BENCH_SCENE_thin    := barrier.relative_d_hat=2.0e-4 barrier.stiffness=1.25e7# a fifth of d_hat; the same force at half that distance (kappa ~ d_hat^-3)
BENCH_SCENE_tight   := newton.relative_velocity_tolerance=1.0e-4 newton.relative_force_tolerance=5.0e-5 newton.force_tolerance_n=1.0e-6
BENCH_SCENE_sweep   := $(BENCH_SCENE_stiff) $(BENCH_SCENE_tight)
BENCH_ROUTE_fast     :=
BENCH_ROUTE_averaged := element=averaged_volume
BENCH_ROUTE_direct   := +newton.linear_solver=direct
BENCH_ROUTE_plain    := $(BENCH_ROUTE_direct) +newton.patches=false +newton.contact_hessian=positive# textbook projected Newton
bench_changes = $(BENCH_SCENE_$(1)) $(BENCH_ROUTE_$(2))
$(foreach s,press settled stiff thin tight sweep,$(foreach r,fast averaged direct plain,\
  $(eval $(call changed_config,$(BENCH)/configs/$(s)_$(r).yaml,configs/studies/speed/press.yaml,$(call bench_changes,$(s),$(r))))))

$(BENCH)/objects/sphere/bench_object.yaml: configs/studies/speed/sphere.yaml | build-bench
	$(call run,bench_object,--config $<)
$(BENCH)/emboss/coin/emboss.yaml: configs/studies/speed/coin.yaml | build
	$(call run,emboss,--config $<)
$(BENCH)/emboss/weave/emboss.yaml: configs/objects/patterns/weave.yaml | build
	$(call run,emboss,--config $<)
$(BENCH)/objects/coin/decimate.yaml $(BENCH)/objects/weave/decimate.yaml: $(BENCH)/objects/%/decimate.yaml: $(BENCH)/emboss/%/emboss.yaml \
    configs/objects/embossed.yaml configs/objects/decimate/default.yaml | build
	$(call run,decimate,--mesh $(BENCH)/emboss/$*/object.ply --object configs/objects/embossed.yaml --config configs/objects/decimate/default.yaml)
$(BENCH)/objects/coin_5002/decimate.yaml: $(SHARED)/data/tacipc_release/objects/coin_5002.obj configs/objects/printed_indenter.yaml \
    configs/objects/decimate/default.yaml | build
	$(call run,decimate,--mesh $< --object configs/objects/printed_indenter.yaml --config configs/objects/decimate/default.yaml)
bench_object_record = $(BENCH)/objects/$(1)/$(if $(filter sphere,$(1)),bench_object,decimate).yaml

# $(call bench_press,gel,object,motion,route): flags of one press.
bench_press = --gel $(BENCH)/gels/$(1)/gel.msh --object $(BENCH)/objects/$(2)/object.ply \
  $(if $(filter-out sphere,$(2)),--object-config $(call bench_object_config,$(2))) \
  --sensor configs/sensors/mctac.yaml --config $(call bench_config,$(3),$(4)) --sample $(call bench_sample,$(3))
bench_needs = $(BENCH)/gels/$(1)/tetmesh.yaml $(call bench_object_record,$(2)) $(call bench_config,$(3),$(4)) $(call bench_sample,$(3)) \
  configs/sensors/mctac.yaml

# One thread, one process.
define bench_rule
$(BENCH)/runs/$(1)-$(2)-$(3)-$(4)/press.yaml: $(call bench_needs,$(1),$(2),$(3),$(4)) | build
	$(BIN)/press --out $$(@D) --threads 1 --name $(1)-$(2)-$(3)-$(4) $(call bench_press,$(1),$(2),$(3),$(4))
BENCH_RUNS += $(BENCH)/runs/$(1)-$(2)-$(3)-$(4)
endef
BENCH_RUNS :=
$(foreach g,$(BENCH_GELS),$(foreach o,$(BENCH_OBJECTS),$(eval $(call bench_rule,$(g),$(o),press,fast))))
$(foreach g,$(BENCH_GELS),$(foreach o,$(BENCH_RELEASED),$(eval $(call bench_rule,$(g),$(o),stiff,fast))))
$(foreach g,$(BENCH_GELS),$(foreach o,$(BENCH_DIRECT_OBJECTS),$(eval $(call bench_rule,$(g),$(o),press,averaged))))
$(if $(filter 12k,$(BENCH_SHEAR_GELS)),$(eval $(call bench_rule,12k,coin,shear,averaged)))
$(foreach g,$(BENCH_SHEAR_GELS),$(foreach o,$(BENCH_SHEAR_OBJECTS),$(eval $(call bench_rule,$(g),$(o),shear,fast))))
$(foreach g,$(BENCH_DIRECT_GELS),$(foreach o,$(BENCH_DIRECT_OBJECTS),$(eval $(call bench_rule,$(g),$(o),press,direct))))
$(foreach o,$(BENCH_DIRECT_OBJECTS),$(foreach r,press-plain settled-fast tight-fast tight-direct thin-fast,\
  $(eval $(call bench_rule,24k,$(o),$(word 1,$(subst -, ,$(r))),$(word 2,$(subst -, ,$(r)))))))
# One press of 50k vertices by factorisation.
$(if $(filter 50k,$(BENCH_GELS)),$(eval $(call bench_rule,50k,sphere,press,direct)))

# Two threads; two processes at once (the slower one counts).
BENCH_HOW := 24k-coin-press-fast
$(BENCH)/runs/$(BENCH_HOW)-2threads/press.yaml: $(call bench_needs,24k,coin,press,fast) | build
	$(BIN)/press --out $(@D) --threads 2 --name $(BENCH_HOW)-2threads $(call bench_press,24k,coin,press,fast)
$(BENCH)/runs/$(BENCH_HOW)-2processes/press.yaml: $(call bench_needs,24k,coin,press,fast) | build
	$(BIN)/press --out $(@D)-beside --threads 1 --name beside $(call bench_press,24k,coin,press,fast) & beside=$$!; \
	$(BIN)/press --out $(@D) --threads 1 --name $(BENCH_HOW)-2processes $(call bench_press,24k,coin,press,fast) && wait $$beside
BENCH_RUNS += $(BENCH)/runs/$(BENCH_HOW)-2threads $(BENCH)/runs/$(BENCH_HOW)-2processes

$(BENCH)/page/bench_table.yaml: $(addsuffix /press.yaml,$(BENCH_RUNS)) | build-bench
	$(call run,bench_table,$(addprefix --press ,$(BENCH_RUNS)))

.PHONY: bench-press bench-page
bench-page: $(BENCH)/page/bench_table.yaml
	$(call to_docs,$(BENCH)/page/performance.md)
	$(if $(wildcard $(DEFAULTS)/table/table.md),$(call fill_docs,performance.md,defaults=$(DEFAULTS)/table/table.md))
	$(call to_docs,$(BENCH)/page/bench_press.svg $(BENCH)/page/bench_elements.svg,performance)
	@cat $(DOCS)/performance.md
	@echo; echo "estimate reads $(COST_MODEL_MEASURED) from now on"

# Presses run one after the other regardless of JOBS, because parallel work would be measured with them. The table is
# always made again, because other runs may be requested: with .SECONDARY, a table newer than the prerequisites of the
# runs would not trigger them.
bench-press: ## development: Cost of a press by route, size, object and motion (15 minutes; BENCH_GELS=); writes OUT/docs/performance.md and a cost model
bench-press: | build build-bench
	@rm -f $(BENCH)/page/bench_table.yaml
	@$(MAKE) -f Makefile.data --no-print-directory bench-page JOBS=1

# Cost of the default settings, and with one of them changed; docs/performance.md has a mark for the table.
DEFAULTS := $(BENCH)/defaults
DEFAULTS_OBJECTS ?= star letter_a gear weave rings coin#  include the coin of bench-press
DEFAULTS_SHEARED ?= star coin#  objects moved sideways after the press
DEFAULTS_NEAR    ?= $(DEFAULTS_OBJECTS)#  objects compared with a press with a smaller gap
DEFAULTS_GEL     ?= adaptive_0100um
defaults_object = $(if $(filter coin,$(1)),$(BENCH),$(OUT))/objects/$(1)
defaults_config = $(if $(filter default frictionless,$(1)),configs/press,$(DEFAULTS)/configs)/$(1).yaml
defaults_motion = configs/$(if $(filter shear,$(1)),studies/speed/shear,motions/press_0500um).yaml
$(DEFAULTS)/configs/once.yaml: changes := friction.lag=once
$(DEFAULTS)/configs/wide.yaml: changes := barrier.relative_d_hat=1.0e-3
$(DEFAULTS)/configs/near.yaml: changes := barrier.relative_d_hat=5.0e-5
$(DEFAULTS)/configs/once.yaml $(DEFAULTS)/configs/wide.yaml $(DEFAULTS)/configs/near.yaml: configs/press/default.yaml | build
	@mkdir -p $(@D)
	$(BIN)/tacipc set $< $(changes) > $@.new && mv $@.new $@

# $(call defaults_rule,object,motion,configuration)
define defaults_rule
$(DEFAULTS)/runs/$(1)-$(2)-$(3)/press.yaml: $(OUT)/gels/mctac-$(DEFAULTS_GEL)/tetmesh.yaml $(call defaults_object,$(1))/decimate.yaml \
    $(call defaults_config,$(3)) $(call defaults_motion,$(2)) configs/sensors/mctac.yaml | build
	OPENBLAS_NUM_THREADS=1 $(BIN)/press --out $$(@D) --threads 1 --name gel-$(1)-$(2)-$(3) --gel $(OUT)/gels/mctac-$(DEFAULTS_GEL)/gel.msh \
	  --object $(call defaults_object,$(1))/object.ply --object-config configs/objects/embossed.yaml --sensor configs/sensors/mctac.yaml \
	  --config $(call defaults_config,$(3)) --sample $(call defaults_motion,$(2))
DEFAULTS_RUNS += $(DEFAULTS)/runs/$(1)-$(2)-$(3)
endef
DEFAULTS_RUNS :=
$(foreach o,$(DEFAULTS_OBJECTS),$(foreach c,default once frictionless wide $(if $(filter $(o),$(DEFAULTS_NEAR)),near),\
  $(eval $(call defaults_rule,$(o),press,$(c)))))
$(foreach o,$(filter $(DEFAULTS_OBJECTS),$(DEFAULTS_SHEARED)),$(eval $(call defaults_rule,$(o),shear,default)))

$(DEFAULTS)/table/defaults_table.yaml: $(addsuffix /press.yaml,$(DEFAULTS_RUNS)) | build-bench
	$(call run,defaults_table,$(addprefix --press ,$(DEFAULTS_RUNS)))

.PHONY: bench-default bench-default-page
bench-default-page: $(DEFAULTS)/table/defaults_table.yaml
	@$(call fill_docs,performance.md,defaults=$(DEFAULTS)/table/table.md)
	@cat $(DEFAULTS)/table/table.md

bench-default: ## development: Cost of a press as shipped, and with one setting changed (a quarter of an hour); writes the table in OUT/docs/performance.md
bench-default: | build build-bench
	@rm -f $(DEFAULTS)/table/defaults_table.yaml
	@$(MAKE) -f Makefile.data --no-print-directory bench-default-page JOBS=1
