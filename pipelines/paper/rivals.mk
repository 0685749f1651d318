# TACTO, Taxim, FOTS and constants published for this very sensor on the photographs of sim2real: make -f Makefile.data rivals [CASES=…].
# Each has its light from the balls that calibrate ours. $(basename CASES)/rivals.yaml says which rows are made; docs/sim2real.md has the protocol.
$(call uses,paper/sim2real paper/paper)

.PHONY: rivals
ifneq ($(filter rivals paper-real paper-fragment-real depth-rivals,$(MAKECMDGOALS)),)
RIVALS := $(OUT)/paper/rivals/$(cases_name)
RIVALS_CONFIGS := $(basename $(CASES))
RIVALS_TABLE := $(wildcard $(RIVALS_CONFIGS)/rivals.yaml)
RIVALS_BLUR := $(if $(CASES_CALIBRATE),$(shell $(BIN)/tacipc get $(CASES_CALIBRATE) blur_px))
RIVALS_SEEDS := 1 2 3
ifeq ($(or $(RIVALS_TABLE),$(filter-out rivals,$(MAKECMDGOALS))),)
  $(error rivals: $(RIVALS_CONFIGS)/rivals.yaml does not exist)
endif

# Their lights. Circles that are not the contact's rim are no labels for them: then the contacts are those of our fit.
rivals_balls := $(if $(CASES_TABLE),--balls $(SIM2REAL)/calibrate/balls.csv)
RIVALS_FITS := taxim_released taxim_pooled tacto $(RIVALS_SEEDS:%=fots_%)
$(RIVALS)/fits/taxim_%.yaml: configs/rivals/calibrate/taxim_%.yaml
	mkdir -p $(@D)
	cp $< $@
$(RIVALS)/fits/fots_%.yaml: configs/rivals/calibrate/fots.yaml | build
	mkdir -p $(@D)
	$(BIN)/tacipc set $< seed=$* > $@
$(RIVALS)/fits/tacto.yaml: $(RIVALS_CONFIGS)/tacto_lamps.yaml
	mkdir -p $(@D)
	{ echo 'model: metallic_roughness'; cat $<; } > $@
$(RIVALS_FITS:%=$(RIVALS)/calibrate/%/calibrate.yaml): $(RIVALS)/calibrate/%/calibrate.yaml: $(RIVALS)/fits/%.yaml $(background_record) $(if $(CASES_TABLE),$(SIM2REAL)/calibrate/calibrate.yaml) $(CASES_CALIBRATE) | build
	$(call run,calibrate,$(calibration) --rival $< $(rivals_balls))

# $(call rival,method,configuration,changed keys,light's file,its record)
RIVAL_METHODS :=
define rival
RIVAL_METHODS += $(1)
RIVAL_LIGHT_$(1) := $(addprefix --light ,$(4))
RIVAL_RECORD_$(1) := $(5)
$(RIVALS)/configs/$(1).yaml: configs/rivals/baseline/$(2).yaml $(CASES_CALIBRATE) | build
	mkdir -p $$(@D)
	$(BIN)/tacipc set $$< $(3) > $$@
endef
rival_blurred = +shading.final_blur_px=$(RIVALS_BLUR)
define rival_pair
$(call rival,$(1),$(2),$(rival_blurred),$(3),$(4))
$(call rival,$(1)-own,$(2),$(rival_blurred),$(3),$(4))
$(call rival,$(1)-sharp,$(2),,$(3),$(4))
endef
$(eval $(call rival_pair,tacto-pure,tacto,$(RIVALS_CONFIGS)/tacto_lamps.yaml,$(RIVALS_CONFIGS)/tacto_lamps.yaml))
$(eval $(call rival_pair,tacto,tacto,$(RIVALS)/calibrate/tacto/light.yaml,$(RIVALS)/calibrate/tacto/calibrate.yaml))
$(eval $(call rival_pair,chen,chen_2022,,))
$(eval $(call rival_pair,taxim-released,taxim,$(RIVALS)/calibrate/taxim_released/light.npy,$(RIVALS)/calibrate/taxim_released/calibrate.yaml))
$(eval $(call rival_pair,taxim,taxim,$(RIVALS)/calibrate/taxim_pooled/light.npy,$(RIVALS)/calibrate/taxim_pooled/calibrate.yaml))
$(foreach s,$(RIVALS_SEEDS),$(eval $(call rival_pair,fots$(filter-out 1,$(s)),fots,$(RIVALS)/calibrate/fots_$(s)/light.npy,$(RIVALS)/calibrate/fots_$(s)/calibrate.yaml)))
$(eval $(call rival,tacto-noise,tacto,+shading.noise_codes=7,$(RIVALS_CONFIGS)/tacto_lamps.yaml,$(RIVALS_CONFIGS)/tacto_lamps.yaml))
# Their light on other membranes: what is light, and what membrane.
$(eval $(call rival,fots-on-taxim,taxim,shading.model=network $(rival_blurred),$(RIVALS)/calibrate/fots_1/light.npy,$(RIVALS)/calibrate/fots_1/calibrate.yaml))
$(eval $(call rival,fots-on-ours,given,shading.model=network $(rival_blurred),$(RIVALS)/calibrate/fots_1/light.npy,$(RIVALS)/calibrate/fots_1/calibrate.yaml))
$(eval $(call rival,taxim-on-ours,given,shading.model=table $(rival_blurred),$(RIVALS)/calibrate/taxim_pooled/light.npy,$(RIVALS)/calibrate/taxim_pooled/calibrate.yaml))

# What an object's images are made of: it where our fit has put it, or where a fit with this method puts it, or our membranes of it.
rival_shape_ours = $(foreach i,$(CASES_IMAGES_$(1)),$(SIM2REAL)/ours/$(1)/depth/$(i).exr)
rival_shape = $(if $(filter %-on-ours,$(1)),--depth $(call rival_shape_ours,$(2)),$(if $(filter %-own,$(1)),--object $(call cases_press,$(2))/indenter/object.ply \
  --pose $(call cases_press,$(2))/press/object_pose.npy --places $(SIM2REAL)/cases/objects/$(2)/shade.yaml --photograph $(call cases_photograph,$(CASES_FIT_$(2))),$(call cases_posed,$(2))))
# Frames under the photographs' names: $(call rival_named,object,folder of the frames)
rival_named = frames=($(call cases_frames,$(1),$(2),0,tactile.png)); i=0; for image in $(CASES_IMAGES_$(1)); do cp "$${frames[i]}" $(@D)/$$image.png; i=$$((i + 1)); done; touch $@
define rival_images
$(RIVALS)/runs/$(1)/$(2)/baseline.yaml: $(SIM2REAL)/ours/$(2)/shade.yaml $(RIVALS)/configs/$(1).yaml $(RIVAL_RECORD_$(1)) | build
	$$(call run,baseline,--config $(RIVALS)/configs/$(1).yaml --sensor $(CASES_SENSOR) --background $(cases_background) $(RIVAL_LIGHT_$(1)) $(call rival_shape,$(1),$(2)))
$(RIVALS)/simulated/$(1)/$(2)/shade.yaml: $(RIVALS)/runs/$(1)/$(2)/baseline.yaml
	mkdir -p $$(@D)
	$$(call rival_named,$(2),$(RIVALS)/runs/$(1)/$(2))
endef
$(foreach m,$(RIVAL_METHODS),$(foreach o,$(CASES_OBJECTS),$(eval $(call rival_images,$(m),$(o)))))

# Our light on their membranes, and light without its last blur: ours at the place found with it.
# $(call rival_shaded,method,object,light's file,prerequisites,what else)
define rival_shaded
$(RIVALS)/simulated/$(1)/$(2)/shade.yaml: $(4) | build
	$$(call run,shade,--sensor $(CASES_SENSOR) --background $(cases_background) --light $(3) $(5))
endef
rival_shapes = --config $(SIM2REAL)/cases/objects/$(1)/shade.yaml --shapes $(call cases_frames,$(1),$(2),0,indentation.exr)
define rival_sharp_light
$(RIVALS)/sharp/$(1).yaml: $(2)/calibrate.yaml | build
	mkdir -p $$(@D)
	$(BIN)/tacipc set $(2)/light.yaml light_field.blur_px=0 > $$@
endef
$(eval $(call rival_sharp_light,ours,$(SIM2REAL)/calibrate))
$(eval $(call rival_sharp_light,depth-based,$(SIM2REAL)/rival/calibrate))
define rival_object
$(foreach m,taxim fots tacto,$(call rival_shaded,ours-on-$(m),$(1),$(SIM2REAL)/calibrate/light.yaml,$(RIVALS)/runs/$(m)/$(1)/baseline.yaml $(SIM2REAL)/calibrate/calibrate.yaml,$(call rival_shapes,$(1),$(RIVALS)/runs/$(m)/$(1)))
)
$(call rival_shaded,depth-based-sharp,$(1),$(RIVALS)/sharp/depth-based.yaml,$(RIVALS)/sharp/depth-based.yaml $(SIM2REAL)/rival/objects/$(1)/baseline.yaml,$(call rival_shapes,$(1),$(SIM2REAL)/rival/objects/$(1)))
$(RIVALS)/sharp/$(1).places.yaml: $(SIM2REAL)/ours/$(1)/shade.yaml | build
	mkdir -p $$(@D)
	$(if $(CASES_TABLE),cp $(SIM2REAL)/cases/objects/$(1)/shade.yaml $$@,{ read -r x; read -r y; read -r yaw; } < <($(BIN)/tacipc get $$< summary.center_px summary.yaw_deg); \
	$(BIN)/tacipc set $(SIM2REAL)/cases/objects/$(1)/shade.yaml -fit "place.center_px=[$$$$x, $$$$y]" "+place.yaw_deg=$$$$yaw" > $$@)
$(call rival_shaded,ours-sharp,$(1),$(RIVALS)/sharp/ours.yaml,$(RIVALS)/sharp/ours.yaml $(RIVALS)/sharp/$(1).places.yaml,--config $(RIVALS)/sharp/$(1).places.yaml --press $(call cases_press,$(1))/press --gel $(SIM2REAL)/gel/gel.msh $(if $(CASES_TABLE),--contact $(SIM2REAL)/calibrate/contact.yaml))
endef
$(foreach o,$(CASES_OBJECTS),$(eval $(call rival_object,$(o))))

# Scored as ours are; of FOTS' network every seed is a run of its row.
rivals_images = $(foreach o,$(CASES_OBJECTS),$(foreach i,$(CASES_IMAGES_$(o)),$(RIVALS)/simulated/$(1)/$(o)/$(i).png))
$(foreach m,$(RIVAL_METHODS) ours-on-taxim ours-on-fots ours-on-tacto depth-based-sharp ours-sharp,$(eval $(RIVALS)/metrics/$(m)/metrics.yaml: $(foreach o,$(CASES_OBJECTS),$(RIVALS)/simulated/$(m)/$(o)/shade.yaml)))
$(RIVALS)/metrics/%/metrics.yaml: $(SIM2REAL)/cases/cases.yaml | build
	$(call run,metrics,--config $(SIM2REAL)/cases/metrics.yaml --images $(call rivals_images,$*) --reference $(CASES_REAL))
rivals_from = $(if $(filter ours depth-based background,$(1)),$(SIM2REAL),$(RIVALS))/metrics/$(1)
rivals_pictures = $(addprefix $(1)=,$(if $(filter ours depth-based,$(1)),$(call sim2real_images,$(1)),$(call rivals_images,$(1))))
# $(call rivals_runs,method): the folders of metrics that its row is made of
rivals_runs = $(if $(filter fots-seeds%,$(1)),$(foreach s,$(RIVALS_SEEDS),$(call rivals_from,fots$(filter-out 1,$(s))$(1:fots-seeds%=%))),$(call rivals_from,$(1)))
# $(call rivals_methods,table,heading of a list): methods that it names
rivals_methods = $(sort $(shell sed -nE 's/.*[{ ]$(2): .*method: ([a-z0-9-]+)[,}].*/\1/p' $(1)))
RIVALS_ROWS := $(if $(RIVALS_TABLE),$(call rivals_methods,$(RIVALS_TABLE),name))
RIVALS_SHOWN := $(if $(RIVALS_TABLE),$(filter-out photograph,$(call rivals_methods,$(RIVALS_TABLE),heading)))
$(RIVALS)/tabulate.yaml: $(RIVALS_TABLE) $(foreach m,$(RIVALS_ROWS),$(addsuffix /metrics.yaml,$(call rivals_runs,$(m)))) | build
	$(call run,tabulate,--config $(RIVALS_TABLE) --samples $(foreach m,$(RIVALS_ROWS),$(foreach r,$(call rivals_runs,$(m)),$(m)=$(r)/samples.csv)) \
	  --pictures $(addprefix photograph=,$(CASES_REAL)) $(foreach m,$(RIVALS_SHOWN),$(call rivals_pictures,$(m))))

# docs/sim2real.md has places for the tables of the shipped benchmarks.
rivals: $(RIVALS)/tabulate.yaml ## studies: TACTO, Taxim, FOTS beside ours on the photographs of sim2real: CASES=… (needs SHARED)
	@! grep -qsxF '<!-- rivals_$(cases_name) -->' docs/sim2real.md || $(call fill_docs,sim2real.md,rivals_$(cases_name)=$(RIVALS)/table.md)
	@echo; echo "Look at $(RIVALS)/table.md"
else
rivals:
endif
