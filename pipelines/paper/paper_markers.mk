# The marker part of the paper's benchmark: marker displacements by TacIPC and Tacchi, under board3 moved sideways and
# turned, and compared with vectors measured in photographs (FOTS). It writes fragments of a page and their pictures to
# $(OUT)/paper/markers (for paper-quick to $(OUT)/paper-quick/markers): board3.md, fots.md, paper_results/*.svg. It
# needs SHARED (data/tacipc_release, data/fots_markers); without it the fragments state that.
$(call uses,paper/paper paper/board3)

RIVALS_MARKERS := $(PAPER)/markers
RIVALS_RUNS := $(OUT)/paper/marker_runs

# $(call tacchi_run,folder,key=value …,changed keys of the numerics) with the keys name, numerics (of
# configs/rivals/mpm), sensor, motion, object (the record next to its object.ply) and object_yaml. Only markers are
# used: no height maps. A run that fails its half-speed check gives a row that states this.
define tacchi_run
$(call fields,tacchi,name numerics sensor motion object object_yaml,$(2))
$(call changed_config,$(1).config.yaml,configs/rivals/mpm/$(tacchi_numerics).yaml,pixels=none $(3))
$(1)/mpm.yaml: $(1).config.yaml $(tacchi_sensor) $(tacchi_motion) $(tacchi_object) $(tacchi_object_yaml) $(always) | build
	$$(call try,mpm,--name $(tacchi_name) --config $(1).config.yaml --sensor $(tacchi_sensor) --sample $(tacchi_motion) \
	  --object $(dir $(tacchi_object))object.ply --object-config $(tacchi_object_yaml))
endef

# Configurations of Tacchi: its numerics on the sensor's gel, and with the true density on a coarse grid, checked at
# half the speed. Nodes at the rim of the object's reach get little of its mass, and the gel creeps there, more with
# slower motion: 1e5 times a particle's mass is not enough (docs/mpm.md). The rim of board3 may turn faster, because its
# contact is a third as far from the axis.
RIVALS_LEGACY := legacy_mctac
RIVALS_PHYSICAL := coarse_checked
RIVALS_PHYSICAL_KEYS_shear := object.mass_ratio=1.0e+7 object.press_speed_mm_s=75 object.move_speed_mm_s=75
RIVALS_PHYSICAL_KEYS_twist := object.mass_ratio=1.0e+7 object.press_speed_mm_s=75 object.move_speed_mm_s=141

# board3. The press runs are those of the target board3, on TacIPC's own gel and on the published one.
RIVALS_BOARD3 := $(RIVALS_RUNS)/board3
RIVALS_MESHES := focused_0200um import_paper_3mm
rivals_press = $(BOARD3)/$(1)-friction_viscous/board3_$(2)/press
$(foreach m,$(filter-out $(if $(filter friction_viscous,$(BOARD3_PRESS)),$(BOARD3_MESH)),$(RIVALS_MESHES)),$(foreach s,$(BOARD3_SAMPLES), \
  $(eval $(call board3_rules,$(BOARD3)/$(m)-friction_viscous/$(s),$(s),$(m),$(s),configs/press/friction_viscous.yaml))))

# $(call board3_tacchi,name,motion,numerics,keys)
board3_tacchi = $(call tacchi_run,$(RIVALS_BOARD3)/$(1)/$(2),name=$(1) numerics=$(3) sensor=configs/sensors/mctac_3mm.yaml \
  motion=configs/studies/board3/board3_$(2).yaml object=$(BOARD3)/object/decimate.yaml object_yaml=configs/objects/printed_indenter.yaml,$(4))
$(foreach m,shear twist,$(eval $(call board3_tacchi,tacchi_legacy,$(m),$(RIVALS_LEGACY)))\
  $(eval $(call board3_tacchi,tacchi_physical,$(m),$(RIVALS_PHYSICAL),$(RIVALS_PHYSICAL_KEYS_$(m)))))

# One value changed at a time, in the shear, from Tacchi's published ones: name and keys. The true density gets the time
# step that keeps the Courant number (0.1 ms / sqrt(1e6 / 1010)).
RIVALS_FACTORS := points_6 points_60 within_100um light_object drag_20 depth_of_object grid_0400um true_density glued_nodes published_material
RIVALS_KEYS_points_6 := object.samples_per_mm2=6
RIVALS_KEYS_points_60 := object.samples_per_mm2=60
RIVALS_KEYS_within_100um := motion.frame_criterion=within_100um
RIVALS_KEYS_light_object := object.mass_ratio=0.01
RIVALS_KEYS_drag_20 := object.move_speed_mm_s=20
RIVALS_KEYS_depth_of_object := motion.depth_of=object
RIVALS_KEYS_grid_0400um := grid.spacing_mm=0.4
RIVALS_KEYS_true_density := material.density_kg_m3=1010 time.step_s=3.178e-6
RIVALS_KEYS_glued_nodes := gel.glued=nodes -gel.fixed_layers
RIVALS_KEYS_published_material := +material.youngs_modulus_pa=1.45e+5 +material.poissons_ratio=0.45
$(foreach f,$(RIVALS_FACTORS),$(eval $(call board3_tacchi,$(f),shear,$(RIVALS_LEGACY),$(RIVALS_KEYS_$(f)))))
# One value of TacIPC changed: enough friction to prevent any slip.
RIVALS_FRICTIONS := 5
$(foreach f,$(RIVALS_FRICTIONS),\
  $(eval $(call changed_config,$(RIVALS_BOARD3)/friction_$(f).config.yaml,configs/press/friction_viscous.yaml,friction.coefficient=$(f))) \
  $(eval $(call board3_rules,$(RIVALS_BOARD3)/friction_$(f),friction_$(f),focused_0200um,board3_shear,$(RIVALS_BOARD3)/friction_$(f).config.yaml)))

RIVALS_BOARD3_RUNS := $(foreach m,$(RIVALS_MESHES),$(foreach s,shear twist,$(call rivals_press,$(m),$(s)))) \
  $(foreach t,tacchi_legacy tacchi_physical,$(foreach s,shear twist,$(RIVALS_BOARD3)/$(t)/$(s)))
RIVALS_BOARD3_FACTORS := $(RIVALS_FRICTIONS:%=$(RIVALS_BOARD3)/friction_%/press) $(RIVALS_FACTORS:%=$(RIVALS_BOARD3)/%/shear)

# Quick variant with a ball, coarse and short.
RIVALS_QUICK := $(RIVALS_RUNS)/quick
$(RIVALS_QUICK)/ball/indenter.yaml: configs/studies/paper/markers/quick_ball.yaml $(always) | build
	$(call run,indenter,--config $<)
$(RIVALS_QUICK)/object/decimate.yaml: $(RIVALS_QUICK)/ball/indenter.yaml configs/objects/embossed.yaml configs/objects/decimate/default.yaml $(always) | build
	$(call run,decimate,--mesh $(RIVALS_QUICK)/ball/object.ply --object configs/objects/embossed.yaml --config configs/objects/decimate/default.yaml)
$(eval $(call sample_rules,$(RIVALS_QUICK)/tacipc,name=tacipc object=$(RIVALS_QUICK)/object object_yaml=configs/objects/embossed.yaml sensor=mctac_3mm \
  mesh=adaptive_0400um motion=configs/studies/paper/markers/quick_shear.yaml press=configs/press/friction_viscous.yaml by=try))
# $(call quick_tacchi,name,numerics,keys)
quick_tacchi = $(call tacchi_run,$(RIVALS_QUICK)/$(1),name=$(1) numerics=$(2) object=$(RIVALS_QUICK)/object/decimate.yaml \
  object_yaml=configs/objects/embossed.yaml sensor=configs/sensors/mctac_3mm.yaml motion=configs/studies/paper/markers/quick_shear.yaml,$(3))
RIVALS_QUICK_PHYSICAL := gel.spacing_mm=0.5 grid.spacing_mm=1 object.press_speed_mm_s=200 object.move_speed_mm_s=200 half_speed.largest_change=0.2
$(eval $(call quick_tacchi,tacchi_legacy,$(RIVALS_LEGACY),object.samples_per_mm2=60))
$(eval $(call quick_tacchi,tacchi_physical,$(RIVALS_PHYSICAL),$(RIVALS_QUICK_PHYSICAL)))
$(eval $(call quick_tacchi,points_6,$(RIVALS_LEGACY),object.samples_per_mm2=6))

# $(call comparison_rule,title,runs,factors): $(RIVALS_RUNS)/pages/<title>
define comparison_rule
$(RIVALS_RUNS)/pages/$(1)/compare_simulators.yaml: configs/studies/paper/markers/$(1).yaml \
    $(foreach r,$(2) $(3),$(r)/$(if $(filter %/press,$(r)),press,mpm).yaml) $(always) | build-verification
	$$(call run,compare_simulators,--config configs/studies/paper/markers/$(1).yaml $(2:%=--run %) $(3:%=--factor %))
endef
$(eval $(call comparison_rule,board3,$(RIVALS_BOARD3_RUNS),$(RIVALS_BOARD3_FACTORS)))
$(eval $(call comparison_rule,quick,$(RIVALS_QUICK)/tacipc/press $(RIVALS_QUICK)/tacchi_legacy $(RIVALS_QUICK)/tacchi_physical,$(RIVALS_QUICK)/points_6))

.PHONY: paper-markers paper-quick-markers paper-board3-fragment paper-quick-fragment paper-board3-folders paper-quick-folders
paper-board3-folders:
	$(call paper_folders,board3,$(RIVALS_BOARD3_RUNS) $(RIVALS_BOARD3_FACTORS) $(BOARD3)/object $(RIVALS_MESHES:%=$(OUT)/gels/mctac_3mm-%) \
	  $(RIVALS_RUNS)/pages/board3)
paper-quick-folders:
	$(call paper_folders,quick,$(RIVALS_QUICK) $(OUT)/gels/mctac_3mm-adaptive_0400um $(RIVALS_RUNS)/pages/quick)
paper-board3-fragment: paper-board3-folders
paper-quick-fragment: paper-quick-folders
paper-board3-fragment: $(if $(wildcard $(BOARD3_OBJECT)),$(RIVALS_RUNS)/pages/board3/compare_simulators.yaml)
paper-quick-fragment: $(RIVALS_RUNS)/pages/quick/compare_simulators.yaml
# $(call put_fragment,page,here if there is such a file): copies the fragment and its pictures, or writes why there are
# none
put_fragment = @mkdir -p $(RIVALS_MARKERS)/paper_results; \
  if [ -e $(2) ]; then cp $(RIVALS_RUNS)/pages/$(1)/$(1).md $(RIVALS_MARKERS)/board3.md && cp $(RIVALS_RUNS)/pages/$(1)/*.csv $(RIVALS_MARKERS)/ && \
    cp $(RIVALS_RUNS)/pages/$(1)/paper_results/*.svg $(RIVALS_MARKERS)/paper_results/; \
  else echo "Not run: there is no $(notdir $(2)) below SHARED." > $(RIVALS_MARKERS)/board3.md; fi
paper-board3-fragment:
	$(call put_fragment,board3,$(BOARD3_OBJECT))
paper-quick-fragment:
	$(call put_fragment,quick,configs/studies/paper/markers/quick.yaml)

# Marker vectors of FOTS: rules of pipelines/paper/fots.mk with Tacchi's rows. They run in a make of their own, because
# they are made from the benchmark's file.
rivals_fots = @if [ -e $(SHARED)/data/fots_markers ]; then $(MAKE) -f Makefile.data --no-print-directory fots-tacchi MARKERS=$(1) $(2); \
  else mkdir -p $(RIVALS_MARKERS); echo "Not run: there is no fots_markers below SHARED." > $(RIVALS_MARKERS)/fots.md; fi
.PHONY: paper-fots-fragment paper-quick-fots-fragment
paper-fots-fragment: | build
	$(call rivals_fots,configs/studies/fots/fots_markers.yaml)
paper-quick-fots-fragment: | build
	$(call rivals_fots,configs/studies/paper/markers/quick_fots.yaml,FOTS_TACCHI='tacchi_legacy tacchi_physical' \
	  FOTS_TACCHI_KEYS='gel.spacing_mm=0.425 grid.spacing_mm=0.85 object.press_speed_mm_s=400 object.move_speed_mm_s=400' FOTS_CHECKED=)

paper-markers: ## studies: Marker displacement by TacIPC and Tacchi (needs SHARED; an hour and a half): fragments in OUT/paper/markers
paper-markers: paper-board3-fragment paper-fots-fragment
	@echo; echo "Look at $(RIVALS_MARKERS)/board3.md and fots.md"
paper-quick-markers: paper-quick-fragment paper-quick-fots-fragment ## studies: paper-markers in a minute, coarse and short
	@echo; echo "Look at $(RIVALS_MARKERS)/board3.md and fots.md"
