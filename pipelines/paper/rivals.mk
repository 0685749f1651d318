# TACTO, Taxim, FOTS and constants published for this very sensor on the photographs of sim2real: make -f Makefile.data
# rivals [CASES=…].
# The light of each is fitted to the photographs that calibrate TacIPC: balls, and known objects if the file names them;
# rows `-balls` use only balls. $(basename CASES)/rivals.yaml selects the rows; docs/sim2real.md has the protocol.
$(call uses,paper/sim2real paper/paper)

.PHONY: rivals build-bench-rivals
ifneq ($(filter rivals paper-real paper-fragment-real depth-rivals,$(MAKECMDGOALS)),)
RIVALS := $(OUT)/paper/rivals/$(cases_name)
RIVALS_CONFIGS := $(basename $(CASES))
RIVALS_TABLE := $(wildcard $(RIVALS_CONFIGS)/rivals.yaml)
RIVALS_BLUR := $(if $(CASES_CALIBRATE),$(shell $(BIN)/tacipc get $(CASES_CALIBRATE) blur_px))
RIVALS_SEEDS := 1 2 3
ifeq ($(or $(RIVALS_TABLE),$(filter-out rivals,$(MAKECMDGOALS))),)
  $(error rivals: $(RIVALS_CONFIGS)/rivals.yaml does not exist)
endif

# Known objects for fitting the lights, at the positions of TacIPC's fit: rigid, from straight above, and along the
# camera's rays.
$(eval $(call changed_config,$(RIVALS)/rigid/parallel.yaml,configs/rivals/baseline/rigid.yaml,+rays=parallel))
$(eval $(call changed_config,$(RIVALS)/rigid/refracted.yaml,configs/rivals/baseline/rigid.yaml,))
define rivals_rigid
$(RIVALS)/rigid/$(1)/$(2)/baseline.yaml: $(SIM2REAL)/ours/$(2)/shade.yaml $(RIVALS)/rigid/$(1).yaml $(always) | build
	$$(call run,baseline,--config $(RIVALS)/rigid/$(1).yaml --sensor $(CASES_SENSOR) $(call cases_posed,$(2)))
endef
$(foreach r,parallel refracted,$(foreach o,$(CASES_KNOWN),$(eval $(call rivals_rigid,$(r),$(o)))))
rivals_rays = $(if $(filter tacto,$(1)),refracted,parallel)

# Lights of the other simulators. Circles that are not the contact's rim cannot serve as labels; then the contacts are
# those of TacIPC's fit.
rivals_balls := $(if $(CASES_TABLE),--balls $(SIM2REAL)/calibrate/balls.csv)
$(foreach f,taxim_released taxim_pooled,$(eval $(call changed_config,$(RIVALS)/fits/$(f).yaml,configs/rivals/calibrate/$(f).yaml,)))
$(foreach s,$(RIVALS_SEEDS),$(eval $(call changed_config,$(RIVALS)/fits/fots_$(s).yaml,configs/rivals/calibrate/fots.yaml,seed=$(s))))
$(RIVALS)/fits/tacto.yaml: $(RIVALS_CONFIGS)/tacto_lamps.yaml FORCE
	$(call replace_if_changed_by,{ echo 'model: metallic_roughness'; cat $<; })
# $(call rivals_fit,fit)
define rivals_fit
$(RIVALS)/calibrate/$(1)/calibrate.yaml: $(RIVALS)/fits/$(1).yaml \
    $(foreach o,$(CASES_KNOWN),$(RIVALS)/rigid/$(call rivals_rays,$(1))/$(o)/baseline.yaml) $(background_record) \
    $(if $(CASES_TABLE),$(SIM2REAL)/calibrate/calibrate.yaml) $(CASES_CALIBRATE) $(CASES_SENSOR) $(always) | build
	$$(call run,calibrate,$$(calibration) --rival $(RIVALS)/fits/$(1).yaml $(rivals_balls) \
	  $(if $(CASES_KNOWN),--shapes $(foreach o,$(CASES_KNOWN),$(RIVALS)/rigid/$(call rivals_rays,$(1))/$(o)/frame_$$(call known_frame,$(o),-1)/indentation.exr)))
endef
$(foreach f,taxim_released taxim_pooled tacto $(RIVALS_SEEDS:%=fots_%),$(eval $(call rivals_fit,$(f))))
# Lights from balls alone, if known objects also calibrate; the depth-based method's balls are at the positions of the
# fit with the objects.
ifneq ($(CASES_KNOWN),)
$(foreach f,taxim_released taxim_pooled tacto $(RIVALS_SEEDS:%=fots_%),$(RIVALS)/calibrate_balls/$(f)/calibrate.yaml): \
  $(RIVALS)/calibrate_balls/%/calibrate.yaml: $(RIVALS)/fits/%.yaml $(CASES_CALIBRATE) $(CASES_SENSOR) $(always) | build
	$(call run,calibrate,$(calibration_balls) --rival $<)
$(RIVALS)/calibrate_balls/ours/calibrate.yaml: $(SIM2REAL)/ball/press/press.yaml $(CASES_CALIBRATE) $(CASES_SENSOR) $(always) | build
	$(call run,calibrate,$(calibration_balls) --press $(SIM2REAL)/ball/press --gel $(SIM2REAL)/gel/gel.msh)
$(RIVALS)/calibrate_balls/depth-based/calibrate.yaml: $(SIM2REAL)/rival/balls/baseline.yaml $(CASES_CALIBRATE) $(CASES_SENSOR) $(always) | build
	$(call run,calibrate,$(calibration_balls) --shapes $(SIM2REAL)/rival/balls/frame_*/indentation.exr)
endif

# Lights of TacIPC and of the depth-based method without their last blur: $(call rival_sharp_light,name,folder of
# calibrate)
define rival_sharp_light
$(RIVALS)/sharp/$(1).yaml: $(2)/calibrate.yaml | build
	mkdir -p $$(@D)
	$(BIN)/tacipc set $(2)/light.yaml light_field.blur_px=0 > $$@
endef
$(eval $(call rival_sharp_light,ours,$(SIM2REAL)/calibrate))
$(eval $(call rival_sharp_light,depth-based,$(SIM2REAL)/rival/calibrate))

# $(call rival,method,configuration or its path,changed keys,light's file,its record)
RIVAL_METHODS :=
define rival
RIVAL_METHODS += $(1)
RIVAL_LIGHT_$(1) := $(addprefix --light ,$(4))
RIVAL_RECORD_$(1) := $(5)
$(call changed_config,$(RIVALS)/configs/$(1).yaml,$(if $(findstring /,$(2)),$(2),configs/rivals/baseline/$(2).yaml),$(3))
endef
rival_blurred = +shading.final_blur_px=$(RIVALS_BLUR)
# $(call rival_rows,method,configuration,light's file below a folder of calibrate): rows from all photographs, at its
# own position, without blur, and from balls alone
define rival_rows
$(call rival,$(1),$(2),$(rival_blurred),$(RIVALS)/calibrate/$(3),$(dir $(RIVALS)/calibrate/$(3))calibrate.yaml)
$(call rival,$(1)-own,$(2),$(rival_blurred),$(RIVALS)/calibrate/$(3),$(dir $(RIVALS)/calibrate/$(3))calibrate.yaml)
$(call rival,$(1)-sharp,$(2),,$(RIVALS)/calibrate/$(3),$(dir $(RIVALS)/calibrate/$(3))calibrate.yaml)
$(call rival,$(1)-balls,$(2),$(rival_blurred),$(RIVALS)/calibrate_balls/$(3),$(dir $(RIVALS)/calibrate_balls/$(3))calibrate.yaml)
endef
$(eval $(call rival_rows,tacto,tacto,tacto/light.yaml))
$(eval $(call rival_rows,taxim-released,taxim,taxim_released/light.npy))
$(eval $(call rival_rows,taxim,taxim,taxim_pooled/light.npy))
$(foreach s,$(RIVALS_SEEDS),$(eval $(call rival_rows,fots$(filter-out 1,$(s)),fots,fots_$(s)/light.npy)))
# Published constants.
$(foreach v,own sharp,$(eval $(call rival,chen-$(v),chen_2022,$(if $(filter own,$(v)),$(rival_blurred)),,)))
$(eval $(call rival,chen,chen_2022,$(rival_blurred),,))
$(eval $(call rival,tacto-pure,tacto,$(rival_blurred),$(RIVALS_CONFIGS)/tacto_lamps.yaml,$(RIVALS_CONFIGS)/tacto_lamps.yaml))
$(eval $(call rival,tacto-pure-sharp,tacto,,$(RIVALS_CONFIGS)/tacto_lamps.yaml,$(RIVALS_CONFIGS)/tacto_lamps.yaml))
$(eval $(call rival,tacto-noise,tacto,+shading.noise_codes=7,$(RIVALS_CONFIGS)/tacto_lamps.yaml,$(RIVALS_CONFIGS)/tacto_lamps.yaml))
# The depth-based method, whose light is fitted like TacIPC's; sim2real.mk has its first row.
$(eval $(call rival,depth-based,$(CASES_BASELINE),+shading.model=light_field,$(SIM2REAL)/rival/calibrate/light.yaml,$(SIM2REAL)/rival/calibrate/calibrate.yaml))
$(eval $(call rival,depth-based-own,$(CASES_BASELINE),+shading.model=light_field,\
  $(SIM2REAL)/rival/calibrate/light.yaml,$(SIM2REAL)/rival/calibrate/calibrate.yaml))
$(eval $(call rival,depth-based-sharp,$(CASES_BASELINE),+shading.model=light_field,$(RIVALS)/sharp/depth-based.yaml,$(RIVALS)/sharp/depth-based.yaml))
$(eval $(call rival,depth-based-balls,$(CASES_BASELINE),+shading.model=light_field,\
  $(RIVALS)/calibrate_balls/depth-based/light.yaml,$(RIVALS)/calibrate_balls/depth-based/calibrate.yaml))
# Light of one simulator on the membranes of another, which separates the effects of light and membrane.
$(foreach m,taxim fots,$(eval $(call rival,ours-on-$(m),$(m),shading.model=light_field,$(SIM2REAL)/calibrate/light.yaml,$(SIM2REAL)/calibrate/calibrate.yaml)))
$(eval $(call rival,ours-on-tacto,rigid,+shading.model=light_field,$(SIM2REAL)/calibrate/light.yaml,$(SIM2REAL)/calibrate/calibrate.yaml))
$(eval $(call rival,fots-on-taxim,taxim,shading.model=network $(rival_blurred),$(RIVALS)/calibrate/fots_1/light.npy,$(RIVALS)/calibrate/fots_1/calibrate.yaml))
$(eval $(call rival,fots-on-ours,given,shading.model=network $(rival_blurred),$(RIVALS)/calibrate/fots_1/light.npy,$(RIVALS)/calibrate/fots_1/calibrate.yaml))
$(eval $(call rival,taxim-on-ours,given,shading.model=table $(rival_blurred),\
  $(RIVALS)/calibrate/taxim_pooled/light.npy,$(RIVALS)/calibrate/taxim_pooled/calibrate.yaml))

# Sources of an object's images: the object at the position of TacIPC's fit, the object at the position of a fit with
# this method, or TacIPC's membranes.
rival_shape_ours = $(foreach i,$(CASES_IMAGES_$(1)),$(SIM2REAL)/ours/$(1)/depth/$(i).exr)
rival_shape_own = --object $(call cases_press,$(1))/indenter/object.ply --pose $(call cases_press,$(1))/press/object_pose.npy \
  --places $(SIM2REAL)/cases/objects/$(1)/shade.yaml --photograph $(call cases_photograph,$(CASES_FIT_$(1)))
rival_shape = $(if $(filter %-on-ours,$(1)),--depth $(call rival_shape_ours,$(2)),\
  $(if $(filter %-own,$(1)),$(call rival_shape_own,$(2)),$(call cases_posed,$(2))))
# Frames under the photographs' names: $(call rival_named,object,folder of the frames)
rival_named = frames=($(call cases_frames,$(1),$(2),0,tactile.png)); i=0; \
  for image in $(CASES_IMAGES_$(1)); do cp "$${frames[i]}" $(@D)/$$image.png; i=$$((i + 1)); done; touch $@
define rival_images
$(RIVALS)/runs/$(1)/$(2)/baseline.yaml: $(SIM2REAL)/ours/$(2)/shade.yaml $(RIVALS)/configs/$(1).yaml $(RIVAL_RECORD_$(1)) $(always) | build
	$$(call run,baseline,--config $(RIVALS)/configs/$(1).yaml --sensor $(CASES_SENSOR) --background $(cases_background) $(RIVAL_LIGHT_$(1)) \
	  $(call rival_shape,$(1),$(2)))
$(RIVALS)/simulated/$(1)/$(2)/shade.yaml: $(RIVALS)/runs/$(1)/$(2)/baseline.yaml
	mkdir -p $$(@D)
	$$(call rival_named,$(2),$(RIVALS)/runs/$(1)/$(2))
endef
$(foreach m,$(RIVAL_METHODS),$(foreach o,$(CASES_OBJECTS),$(eval $(call rival_images,$(m),$(o)))))

# TacIPC's press at the position found with its light: without the slopes of its print, without the last blur, under the
# light of balls alone. $(call rival_shaded,method,object,light's file,its record)
define rival_shaded
$(RIVALS)/simulated/$(1)/$(2)/shade.yaml: $(4) $(RIVALS)/places/$(2).yaml $(always) | build
	$$(call run,shade,--sensor $(CASES_SENSOR) --background $(cases_background) --light $(3) --config $(RIVALS)/places/$(2).yaml \
	  --press $(call cases_press,$(2))/press --gel $(SIM2REAL)/gel/gel.msh $(if $(CASES_TABLE),--contact $(SIM2REAL)/calibrate/contact.yaml))
endef
define rival_object
$(RIVALS)/places/$(1).yaml: $(SIM2REAL)/ours/$(1)/shade.yaml | build
	mkdir -p $$(@D)
	$(if $(CASES_TABLE),cp $(SIM2REAL)/cases/objects/$(1)/shade.yaml $$@,\
	{ read -r x; read -r y; read -r yaw; } < <($(BIN)/tacipc get $$< summary.center_px summary.yaw_deg); \
	$(BIN)/tacipc set $(SIM2REAL)/cases/objects/$(1)/shade.yaml -fit "place.center_px=[$$$$x, $$$$y]" "+place.yaw_deg=$$$$yaw" > $$@)
$(call rival_shaded,ours-light,$(1),$(SIM2REAL)/calibrate/light.yaml,$(SIM2REAL)/calibrate/calibrate.yaml)
$(call rival_shaded,ours-sharp,$(1),$(RIVALS)/sharp/ours.yaml,$(RIVALS)/sharp/ours.yaml)
$(call rival_shaded,ours-balls,$(1),$(RIVALS)/calibrate_balls/ours/light.yaml,$(RIVALS)/calibrate_balls/ours/calibrate.yaml)
endef
$(foreach o,$(CASES_OBJECTS),$(eval $(call rival_object,$(o))))

# Evaluated like TacIPC; every seed of FOTS's network is a run of its row.
rivals_images = $(foreach o,$(CASES_OBJECTS),$(foreach i,$(CASES_IMAGES_$(o)),$(RIVALS)/simulated/$(1)/$(o)/$(i).png))
$(foreach m,$(RIVAL_METHODS) ours-light ours-sharp ours-balls,\
  $(eval $(RIVALS)/metrics/$(m)/metrics.yaml: $(foreach o,$(CASES_OBJECTS),$(RIVALS)/simulated/$(m)/$(o)/shade.yaml)))
$(RIVALS)/metrics/%/metrics.yaml: $(SIM2REAL)/cases/cases.yaml $(always) | build
	$(call run,metrics,--config $(SIM2REAL)/cases/metrics.yaml --images $(call rivals_images,$*) --reference $(CASES_REAL))
rivals_from = $(if $(filter ours depth-based background,$(1)),$(SIM2REAL),$(RIVALS))/metrics/$(1)
rivals_pictures = $(addprefix $(1)=,$(if $(filter ours depth-based,$(1)),$(call sim2real_images,$(1)),$(call rivals_images,$(1))))
# $(call rivals_runs,method): the folders of metrics that its row is made of
rivals_runs = $(if $(filter fots-seeds%,$(1)),$(foreach s,$(RIVALS_SEEDS),$(call rivals_from,fots$(filter-out 1,$(s))$(1:fots-seeds%=%))),\
  $(call rivals_from,$(1)))
# $(call rivals_methods,table,heading of a list): methods that it names
rivals_methods = $(sort $(shell sed -nE 's/.*[{ ]$(2): .*method: ([a-z0-9-]+)[,}].*/\1/p' $(1)))
RIVALS_ROWS := $(if $(RIVALS_TABLE),$(call rivals_methods,$(RIVALS_TABLE),name))
RIVALS_SHOWN := $(if $(RIVALS_TABLE),$(filter-out photograph,$(call rivals_methods,$(RIVALS_TABLE),heading)))
RIVALS_METRICS := $(foreach m,$(RIVALS_ROWS),$(addsuffix /metrics.yaml,$(call rivals_runs,$(m))))

# Cost of an image, along the motion of one object, and of all presses. It is measured last, so that nothing else runs
# at the same time. $(call rivals_speed,further flags)
build-bench-rivals: build
	@$(call compile,$(BUILD),bench_rivals)
RIVALS_TIMED := depth-based tacto taxim fots chen
rivals_presses := $(sort $(foreach o,$(CASES_OBJECTS),$(call cases_press,$(o))/press))
rivals_timed := $(RIVALS_TIMED:%=$(RIVALS)/configs/%.yaml) $(foreach m,$(RIVALS_TIMED),$(RIVAL_RECORD_$(m))) $(rivals_presses:%=%/press.yaml)
rivals_speed = $(call run,bench_rivals,--sensor $(CASES_SENSOR) --press $(rivals_presses) --gel $(SIM2REAL)/gel/gel.msh \
  --object $(dir $(firstword $(rivals_presses)))indenter/object.ply --light $(SIM2REAL)/calibrate/light.yaml \
  --configs $(foreach m,$(RIVALS_TIMED),$(m)=$(RIVALS)/configs/$(m).yaml) \
  --lights $(foreach m,$(RIVALS_TIMED),$(if $(RIVAL_LIGHT_$(m)),$(m)=$(lastword $(RIVAL_LIGHT_$(m))))) $(1))
$(RIVALS)/speed/bench_rivals.yaml: $(rivals_timed) | $(RIVALS_METRICS) build-bench-rivals
	$(call rivals_speed)
$(RIVALS)/tabulate.yaml: $(RIVALS_TABLE) $(RIVALS_METRICS) $(RIVALS)/speed/bench_rivals.yaml $(always) | build
	$(call run,tabulate,--config $(RIVALS_TABLE) --samples $(foreach m,$(RIVALS_ROWS),$(foreach r,$(call rivals_runs,$(m)),$(m)=$(r)/samples.csv)) \
	  --speeds $(RIVALS)/speed/image_speeds.csv --pictures $(addprefix photograph=,$(CASES_REAL)) $(foreach m,$(RIVALS_SHOWN),$(call rivals_pictures,$(m))))

# docs/sim2real.md has marks for the tables of the shipped benchmarks.
rivals: $(RIVALS)/tabulate.yaml ## studies: TACTO, Taxim, FOTS beside ours on the photographs of sim2real: CASES=… (needs SHARED)
	@! grep -qsxF '<!-- rivals_$(cases_name) -->' docs/sim2real.md || $(call fill_docs,sim2real.md,rivals_$(cases_name)=$(RIVALS)/table.md)
	@! grep -qsxF '<!-- speed_$(cases_name) -->' docs/sim2real.md || $(call fill_docs,sim2real.md,speed_$(cases_name)=$(RIVALS)/speed/speeds.md)
	@echo; echo "Look at $(RIVALS)/table.md"
else
rivals:
endif
