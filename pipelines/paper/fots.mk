# Compares marker vectors measured in photographs with simulated ones: make -f Makefile.data fots
# [MARKERS=configs/studies/fots/fots_markers.yaml]
# The file selects the vectors (below SHARED), the simulated and the fixed values; docs/fots.md has the table. ALSO=
# names folders of the same presses by another simulator (markers.npy, marker_displacement.npy, object_pose.npy,
# phase.npy in any folder below), which add rows (ALSO is declared in board3.mk).
$(call uses,paper/board3 paper/paper_markers)

MARKERS ?= configs/studies/fots/fots_markers.yaml#  the benchmark
override MARKERS := $(strip $(MARKERS))
FOTS := $(OUT)/fots/$(basename $(notdir $(MARKERS)))

.PHONY: fots fots-page fots-tacchi
ifneq ($(filter fots fots-page fots-tacchi,$(MAKECMDGOALS)),)
$(call check_name,MARKERS)
$(call check_name,SHARED)
ifeq ($(wildcard $(MARKERS)),)
  $(error MARKERS: $(MARKERS) does not exist)
endif
ifeq ($(wildcard $(SHARED)),)
  $(error SHARED: $(SHARED) does not exist; the measured vectors are looked for there)
endif

# Inputs of the stages are made from the single file first, then make restarts with its variables.
$(FOTS)/cases/cases.yaml: $(MARKERS) $(always) | build
	$(call run,cases,--config $<)
$(FOTS)/cases/cases.mk: $(FOTS)/cases/cases.yaml ;
include $(FOTS)/cases/cases.mk

# Ball, gel and press configuration of the base and of each variant, then a press to each depth.
define fots_variant
$(FOTS)/runs/$(1)/indenter/indenter.yaml: $(FOTS)/cases/cases.yaml $(always) | build
	$$(call run,indenter,--config $(FOTS)/cases/$(1)/indenter.yaml)
$(call changed_config,$(FOTS)/runs/$(1)/settings/sensor.yaml,$(MARKERS_SENSOR),$(addprefix gel.thickness_mm=,$(MARKERS_THICKNESS_MM_$(1))))
$(FOTS)/runs/$(1)/settings/press.yaml: $(MARKERS_PRESS) $(FOTS)/cases/cases.yaml FORCE
	$$(call replace_if_changed_by,cat $(MARKERS_PRESS) $(FOTS)/cases/$(1)/friction.yaml)
$(FOTS)/runs/$(1)/gel/tetmesh.yaml: $(FOTS)/runs/$(1)/settings/sensor.yaml $(MARKERS_MESH) $(always) | build
	$$(call run,tetmesh,--sensor $(FOTS)/runs/$(1)/settings/sensor.yaml --config $(MARKERS_MESH))
endef
define fots_run
$(FOTS)/runs/$(1)/$(2)/press.yaml: $(FOTS)/runs/$(1)/indenter/indenter.yaml $(FOTS)/runs/$(1)/gel/tetmesh.yaml $(FOTS)/runs/$(1)/settings/press.yaml \
    $(always) | build
	$$(call run,press,--name $(1)_$(2) --object $(FOTS)/runs/$(1)/indenter/object.ply --object-config configs/objects/embossed.yaml \
	  --gel $(FOTS)/runs/$(1)/gel/gel.msh --sensor $(FOTS)/runs/$(1)/settings/sensor.yaml \
	  --config $(FOTS)/runs/$(1)/settings/press.yaml --sample $(FOTS)/cases/motion_$(2).yaml)
endef
$(foreach v,$(MARKERS_VARIANTS),$(eval $(call fots_variant,$(v)))$(foreach d,$(MARKERS_DEPTHS),$(eval $(call fots_run,$(v),$(d)))))

# Marker motion by FOTS and Taxim along the travel of the deepest of these presses. FOTS's factors are those published,
# and others fitted to these very vectors, which no other row is: the best that its formulas can do here. Taxim's unit
# responses are those of this gel under a small ball.
FOTS_RIVALS := fots_published fots_fitted taxim_superposition
FOTS_FITTED_KEYS := markers.press_per_mm2=1.26514 markers.shear_per_mm2=0.065174
FOTS_DEEPEST := $(lastword $(MARKERS_DEPTHS))
$(FOTS)/unit/indenter/indenter.yaml: configs/studies/fots/unit_response/indenter.yaml $(always) | build
	$(call run,indenter,--config $<)
$(FOTS)/unit/settings.yaml: $(MARKERS_PRESS) configs/studies/fots/unit_response/friction.yaml FORCE
	$(call replace_if_changed_by,cat $(filter %.yaml,$^))
$(FOTS)/unit/press/press.yaml: $(FOTS)/unit/indenter/indenter.yaml $(FOTS)/unit/settings.yaml configs/studies/fots/unit_response/motion.yaml \
    $(FOTS)/runs/base/gel/tetmesh.yaml $(always) | build
	$(call run,press,--name unit --object $(FOTS)/unit/indenter/object.ply --object-config configs/objects/embossed.yaml --gel $(FOTS)/runs/base/gel/gel.msh \
	  --sensor $(FOTS)/runs/base/settings/sensor.yaml --config $(FOTS)/unit/settings.yaml --sample configs/studies/fots/unit_response/motion.yaml)
$(eval $(call changed_config,$(FOTS)/rivals/fots_published.yaml,configs/rivals/baseline/fots_markers.yaml,))
$(eval $(call changed_config,$(FOTS)/rivals/fots_fitted.yaml,configs/rivals/baseline/fots_markers.yaml,$(FOTS_FITTED_KEYS)))
$(eval $(call changed_config,$(FOTS)/rivals/taxim_superposition.yaml,configs/rivals/baseline/taxim_markers.yaml,))
$(FOTS)/rivals/taxim_superposition/baseline.yaml: $(FOTS)/unit/press/press.yaml
$(FOTS_RIVALS:%=$(FOTS)/rivals/%/baseline.yaml): $(FOTS)/rivals/%/baseline.yaml: $(FOTS)/rivals/%.yaml $(FOTS)/runs/base/$(FOTS_DEEPEST)/press.yaml \
    $(always) | build
	$(call try,baseline,--config $< --sensor $(FOTS)/runs/base/settings/sensor.yaml --object $(FOTS)/runs/base/indenter/object.ply \
	  --press $(FOTS)/runs/base/$(FOTS_DEEPEST) $(if $(filter taxim_superposition,$*),--response $(FOTS)/unit/press))
FOTS_RIVAL_RECORDS := $(FOTS_RIVALS:%=$(FOTS)/rivals/%/baseline.yaml)
fots_rival_runs = $(foreach r,$(FOTS_RIVALS),$(r)=$(FOTS)/rivals/$(r))

$(FOTS)/fit/marker_fit.yaml: $(MARKERS) $(foreach v,$(MARKERS_VARIANTS),$(foreach d,$(MARKERS_DEPTHS),$(FOTS)/runs/$(v)/$(d)/press.yaml)) \
    $(FOTS_RIVAL_RECORDS) $(addprefix $(SHARED)/,$(MARKERS_PRESSED) $(MARKERS_SHEARED)) $(foreach a,$(ALSO),$(shell find $(a) -name "*.npy")) $(always) | build
	$(call run,marker_fit,--config $(MARKERS) --pressed $(SHARED)/$(MARKERS_PRESSED) --sheared $(SHARED)/$(MARKERS_SHEARED) \
	  --runs $(foreach v,$(MARKERS_VARIANTS),$(MARKERS_DEPTHS:%=$(v)=$(FOTS)/runs/$(v)/%)) $(fots_rival_runs) $(foreach a,$(ALSO:%/=%),$(notdir $(a))=$(a)))

# Additional rows of Tacchi, for pipelines/paper/paper_markers.mk:
# - as published, with its particles in a block as large as the gel, and its material: for the sensor's stiffer material
# the published step is too long;
# - the sensor's material with a shorter step;
# - a tenth of the density, with the time step that keeps the Courant number;
# - cells with eight particles instead of one particle for four cells;
# - both, with a hundredth of the density;
# - the true density, checked at half the speed in the shallowest press.
# Presses end when the front reaches the requested depth; the ball is then less deep. Keys given with FOTS_TACCHI_KEYS
# come last.
FOTS_TACCHI_KEYS ?=
FOTS_TACCHI ?= tacchi_legacy tacchi_legacy_sensor_material tacchi_legacy_tenth_density tacchi_legacy_grid_0400um tacchi_legacy_grid_and_density tacchi_physical
FOTS_BLOCK := gel.lattice=block +gel.counts=[127,105,22]
FOTS_NUMERICS_tacchi_legacy := $(RIVALS_LEGACY)
FOTS_KEYS_tacchi_legacy := $(FOTS_BLOCK) +material.youngs_modulus_pa=1.45e+5 +material.poissons_ratio=0.45
FOTS_NUMERICS_tacchi_legacy_sensor_material := $(RIVALS_LEGACY)
FOTS_KEYS_tacchi_legacy_sensor_material := $(FOTS_BLOCK) time.step_s=2.0e-5 motion.check_every=5
FOTS_NUMERICS_tacchi_legacy_tenth_density := $(RIVALS_LEGACY)
FOTS_KEYS_tacchi_legacy_tenth_density := $(FOTS_KEYS_tacchi_legacy) material.density_kg_m3=1.0e+5 time.step_s=3.16e-5 motion.check_every=3
FOTS_NUMERICS_tacchi_legacy_grid_0400um := $(RIVALS_LEGACY)
FOTS_KEYS_tacchi_legacy_grid_0400um := $(FOTS_KEYS_tacchi_legacy) grid.spacing_mm=0.4
FOTS_NUMERICS_tacchi_legacy_grid_and_density := $(RIVALS_LEGACY)
FOTS_KEYS_tacchi_legacy_grid_and_density := $(FOTS_KEYS_tacchi_legacy_grid_0400um) material.density_kg_m3=1.0e+4 time.step_s=3.1e-5 motion.check_every=3
FOTS_NUMERICS_tacchi_physical := $(RIVALS_PHYSICAL)
FOTS_KEYS_tacchi_physical := gel.spacing_mm=0.25 grid.spacing_mm=0.5 \
  object.mass_ratio=1.0e+7 object.press_speed_mm_s=100 object.move_speed_mm_s=100 $(FOTS_TACCHI_KEYS)
FOTS_CHECKED ?= $(firstword $(MARKERS_DEPTHS))# depths of runs that are checked at half the speed
fots_unchecked = $(and $(filter tacchi_physical,$(1)),$(filter-out $(FOTS_CHECKED),$(2)),-half_speed)
# $(call fots_tacchi_run,row,depth)
fots_tacchi_run = $(call tacchi_run,$(FOTS)/runs/$(1)/$(2),name=$(1)_$(2) numerics=$(FOTS_NUMERICS_$(1)) \
  sensor=$(FOTS)/runs/base/settings/sensor.yaml motion=$(FOTS)/cases/motion_$(2).yaml object=$(FOTS)/runs/base/indenter/indenter.yaml \
  object_yaml=configs/objects/embossed.yaml,$(FOTS_KEYS_$(1)) $(fots_unchecked))
$(foreach t,$(FOTS_TACCHI),$(foreach d,$(MARKERS_DEPTHS),$(eval $(call fots_tacchi_run,$(t),$(d)))))

$(FOTS)/fit_tacchi/marker_fit.yaml: $(MARKERS) $(foreach v,$(MARKERS_VARIANTS),$(foreach d,$(MARKERS_DEPTHS),$(FOTS)/runs/$(v)/$(d)/press.yaml)) \
    $(foreach t,$(FOTS_TACCHI),$(foreach d,$(MARKERS_DEPTHS),$(FOTS)/runs/$(t)/$(d)/mpm.yaml)) $(FOTS_RIVAL_RECORDS) \
    $(addprefix $(SHARED)/,$(MARKERS_PRESSED) $(MARKERS_SHEARED)) $(always) | build
	$(call run,marker_fit,--name TacIPC --config $(MARKERS) --pressed $(SHARED)/$(MARKERS_PRESSED) --sheared $(SHARED)/$(MARKERS_SHEARED) \
	  --runs $(foreach v,$(MARKERS_VARIANTS) $(FOTS_TACCHI),$(MARKERS_DEPTHS:%=$(v)=$(FOTS)/runs/$(v)/%)) $(fots_rival_runs))

.PHONY: fots-tacchi-folders
fots-tacchi-folders:
	$(call paper_folders,fots,$(FOTS)/cases $(foreach v,$(MARKERS_VARIANTS),$(FOTS)/runs/$(v)/indenter $(FOTS)/runs/$(v)/gel) \
	  $(foreach v,$(MARKERS_VARIANTS) $(FOTS_TACCHI),$(MARKERS_DEPTHS:%=$(FOTS)/runs/$(v)/%)) $(FOTS)/unit $(FOTS)/rivals $(FOTS)/fit_tacchi)
define fots_legend
`tacchi_legacy`: numerics and material of Tacchi as published.
`tacchi_legacy_sensor_material`: those numerics with the material of the gel.
`tacchi_legacy_tenth_density`: as published, but a tenth as heavy.
`tacchi_legacy_grid_0400um`: as published, but on cells that hold eight particles.
`tacchi_legacy_grid_and_density`: on those and a hundredth as heavy.
`tacchi_physical`: the material and density of the gel, and a coarse grid.
`fots_published`, `fots_fitted`: FOTS with its published factors, and with factors fitted to these very vectors, the most its formulas can do.
`taxim_superposition`: Taxim with unit responses of this gel.
endef
fots-tacchi: $(FOTS)/fit_tacchi/marker_fit.yaml fots-tacchi-folders
	@mkdir -p $(RIVALS_MARKERS)/paper_results
	@cp $(<D)/vectors.csv $(RIVALS_MARKERS)/fots_vectors.csv
	@for picture in $(<D)/*.svg; do cp "$$picture" $(RIVALS_MARKERS)/paper_results/fots_$$(basename "$$picture"); done
	@{ cat $(<D)/others.md; echo; \
	  echo '$(subst $(newline), ,$(fots_legend))'; \
	  echo; cat $(<D)/table.md; for field in shear press; do printf '\n|'; for row in TacIPC $(FOTS_TACCHI) $(FOTS_RIVALS); do printf ' %s |' $$row; done; \
	  printf '\n|'; for row in TacIPC $(FOTS_TACCHI) $(FOTS_RIVALS); do printf -- '---|'; done; printf '\n|'; \
	  printf ' ![TacIPC: %s](paper_results/fots_%s.svg) |' $$field $$field; \
	  for row in $(FOTS_TACCHI) $(FOTS_RIVALS); do \
	    [ ! -e $(<D)/$${row}_$$field.svg ] && printf ' no fit |' || printf ' ![%s: %s](paper_results/fots_%s_%s.svg) |' $$row $$field $$row $$field; \
	  done; echo; done; } > $(RIVALS_MARKERS)/fots.md
	@cat $(RIVALS_MARKERS)/fots.md

# docs/fots.md has a mark for the table of the shipped benchmark.
fots_name := $(basename $(notdir $(MARKERS)))
fots-page: $(FOTS)/fit/marker_fit.yaml
	@if grep -qsxF '<!-- $(fots_name) -->' docs/fots.md; then \
	  $(call fill_docs,fots.md,$(fots_name)=$(FOTS)/fit/table.md); \
	  for field in press shear; do cp $(FOTS)/fit/$$field.svg $(DOCS)/$(fots_name)_$$field.svg; done; fi
	@cat $(FOTS)/fit/table.md
	@echo; echo "Look at $(FOTS)/fit/press.svg and shear.svg; the vectors are in vectors.csv"

fots: fots-page ## studies: Simulated marker vectors against measured ones of a real sensor (needs SHARED; minutes); writes the table in OUT/docs/fots.md
endif
