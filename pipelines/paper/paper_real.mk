# Table I (a) of the paper on photographs: images of TacIPC, Tacchi and the depth-based method, each under light fitted
# to the same balls on its own membranes; then all with the published optics of the other simulators. Results of
# sim2real.mk are used as they are; docs/sim2real.md has the protocol.
$(call uses,paper/sim2real paper/paper paper/rivals)

.PHONY: paper-real
ifneq ($(filter paper-real paper-fragment-real depth-rivals,$(MAKECMDGOALS)),)
PAPER_REAL := $(PAPER)/real/$(cases_name)
PAPER_CONFIGS := $(basename $(CASES))
PAPER_TABLE := $(PAPER_CONFIGS)/table.yaml
ifneq ($(CASES_TABLE),)
  $(error paper-real: $(CASES) tells no depths, which Tacchi's runs need)
endif
$(foreach f,$(PAPER_TABLE) $(addprefix $(PAPER_CONFIGS)/,mpm.yaml legacy_tacchi.yaml legacy_gomes_2021.yaml legacy_exponential_13.yaml),\
  $(if $(wildcard $(f)),,$(error paper-real: $(f) does not exist)))

# Tacchi with each of its published densities of points (6 per mm2 is its default), and with the criterion of its
# program for images. All are rendered under TacIPC's light, so that only membranes differ; the densest and the sparsest
# also under light of their own.
PAPER_TACCHI_LIT := tacchi tacchi-6
PAPER_TACCHI     := $(PAPER_TACCHI_LIT) tacchi-60 tacchi-100um tacchi-image
PAPER_TACCHI_KEYS_tacchi-60    := object.samples_per_mm2=60
PAPER_TACCHI_KEYS_tacchi-6     := object.samples_per_mm2=6
PAPER_TACCHI_KEYS_tacchi-100um := motion.frame_criterion=within_100um
PAPER_TACCHI_KEYS_tacchi-image := object.samples_per_mm2=6 motion.frame_criterion=within_100um
PAPER_TACCHI_KEYS_quick := gel.spacing_mm=0.4 grid.spacing_mm=0.4 time.step_s=1.0e-4#  paper-quick: a tenth of the time
$(foreach t,$(PAPER_TACCHI),$(eval $(call changed_config,$(PAPER_REAL)/$(t)/numerics.yaml,$(PAPER_CONFIGS)/mpm.yaml,\
  $(PAPER_TACCHI_KEYS_$(t)) $(PAPER_TACCHI_KEYS_$(PAPER_KIND)))))

# Tacchi's gel under the balls that calibrate, each at the position and depth that TacIPC's calibration found, and under
# the objects at TacIPC's positions. $(call paper_mpm,which Tacchi,balls/ball_0000 or objects/name,indenter folder)
define paper_mpm
$(PAPER_REAL)/$(1)/$(2)/mpm.yaml: $(PAPER_REAL)/motions/$(2)/motion.yaml $(3)/indenter.yaml $(PAPER_REAL)/$(1)/numerics.yaml $(CASES_SENSOR) $(always) | build
	$$(call run,mpm,--name $(notdir $(2)) --config $(PAPER_REAL)/$(1)/numerics.yaml --sensor $(CASES_SENSOR) --sample $(PAPER_REAL)/motions/$(2)/motion.yaml \
	  --object $(3)/object.ply --object-config configs/objects/embossed.yaml)
endef
PAPER_BALLS := $(if $(CASES_LABELS),$(shell seq -f balls/ball_%04.0f 0 $$(($$(grep -c '[^[:space:]]' $(cases_labels)) - 1))))
$(PAPER_REAL)/motions/balls/ball_%/motion.yaml: $(SIM2REAL)/calibrate/calibrate.yaml
	mkdir -p $(@D)
	mapfile -t balls < <($(BIN)/tacipc table $(<D)/balls.csv --columns x_mm,y_mm,depth_mm); read -r x y depth <<< "$${balls[10#$*]}"; \
	printf 'placement: {center_mm: [%s, %s]}\nmotion: {kind: press, depth_mm: %s, steps: 1}\n' "$$x" "$$y" "$$depth" > $@
define paper_light
$(PAPER_REAL)/$(1)/calibrate/calibrate.yaml: $(foreach b,$(PAPER_BALLS),$(PAPER_REAL)/$(1)/$(b)/mpm.yaml) \
    $(foreach o,$(CASES_KNOWN),$(PAPER_REAL)/$(1)/objects/$(o)/mpm.yaml) $(CASES_CALIBRATE) $(always) | build
	$$(call run,calibrate,$$(calibration) --shapes $(foreach b,$(PAPER_BALLS),$(PAPER_REAL)/$(1)/$(b)/frame_0001/seen_indentation.exr) \
	  $(foreach o,$(CASES_KNOWN),$(PAPER_REAL)/$(1)/objects/$(o)/frame_$(call known_frame,$(o),0)/seen_indentation.exr))
endef
$(foreach t,$(PAPER_TACCHI_LIT),$(eval $(call paper_light,$(t)))$(foreach b,$(PAPER_BALLS),$(eval $(call paper_mpm,$(t),$(b),$(SIM2REAL)/ball/indenter))))

# $(call paper_shade,method,object,light's record,record of the shapes,shapes)
define paper_shade
$(PAPER_REAL)/simulated/$(1)/$(2)/shade.yaml: $(4) $(3) $(always) | build
	$$(call run,shade,$$(call shading,$(2)) --light $(dir $(3))light.yaml --shapes $(5))
endef
# $(call paper_legacy,method,object,configuration,record of the shapes,shapes): images under the photographs' names
define paper_legacy
$(PAPER_REAL)/legacy/$(1)/$(2)/baseline.yaml: $(4) $(PAPER_CONFIGS)/legacy_$(3).yaml $(always) | build
	$$(call run,baseline,--config $(PAPER_CONFIGS)/legacy_$(3).yaml --sensor $(CASES_SENSOR) --background $(cases_background) $(5))
$(PAPER_REAL)/simulated/$(1)/$(2)/shade.yaml: $(PAPER_REAL)/legacy/$(1)/$(2)/baseline.yaml
	mkdir -p $$(@D)
	frames=($(call cases_frames,$(2),$(PAPER_REAL)/legacy/$(1)/$(2),0,tactile.png)); i=0; \
	for image in $(CASES_IMAGES_$(2)); do cp "$$$${frames[i]}" $$(@D)/$$$$image.png; i=$$$$((i + 1)); done
	touch $$@
endef
# $(call paper_tacchi,which Tacchi,object)
paper_tacchi_run = $(PAPER_REAL)/$(1)/objects/$(2)
# $(call paper_tacchi_shade,which Tacchi,object,method,light's record)
paper_tacchi_shade = $(call paper_shade,$(3),$(2),$(4),$(paper_tacchi_run)/mpm.yaml,$(call cases_frames,$(2),$(paper_tacchi_run),1,seen_indentation.exr))
define paper_tacchi
$(call paper_mpm,$(1),objects/$(2),$(SIM2REAL)/objects/$(2)/indenter)
$(if $(filter $(1),$(PAPER_TACCHI_LIT)),$(call paper_tacchi_shade,$(1),$(2),$(1),$(PAPER_REAL)/$(1)/calibrate/calibrate.yaml))
$(call paper_tacchi_shade,$(1),$(2),$(1)-our-light,$(SIM2REAL)/calibrate/calibrate.yaml)

endef
paper_depths = --depth $(foreach i,$(CASES_IMAGES_$(1)),$(2)/$(1)/depth/$(i).exr)
define paper_objects
$(PAPER_REAL)/motions/objects/$(1)/motion.yaml: $(SIM2REAL)/ours/$(1)/shade.yaml $(SIM2REAL)/cases/cases.yaml
	mkdir -p $$(@D)
	{ read -r x; read -r y; read -r yaw; } < <($(BIN)/tacipc get $$< summary.center_mm summary.yaw_deg); \
	echo "placement: {center_mm: [$$$$x, $$$$y], rotate_deg: $$$$yaw}" > $$@
	cat $(SIM2REAL)/cases/objects/$(1)/motion.yaml >> $$@
$(foreach t,$(PAPER_TACCHI),$(call paper_tacchi,$(t),$(1)))
$(call paper_shade,depth-based-our-light,$(1),$(SIM2REAL)/calibrate/calibrate.yaml,$(SIM2REAL)/rival/objects/$(1)/baseline.yaml,\
  $(call cases_frames,$(1),$(SIM2REAL)/rival/objects/$(1),0,indentation.exr))
$(call paper_legacy,legacy-ours,$(1),tacchi,$(SIM2REAL)/ours/$(1)/shade.yaml,$(call paper_depths,$(1),$(SIM2REAL)/ours))
$(call paper_legacy,legacy-tacchi,$(1),tacchi,$(PAPER_REAL)/simulated/tacchi/$(1)/shade.yaml,$(call paper_depths,$(1),$(PAPER_REAL)/simulated/tacchi))
$(call paper_legacy,legacy-depth-based,$(1),gomes_2021,$(SIM2REAL)/ours/$(1)/shade.yaml,$(call cases_posed,$(1)))
$(call paper_legacy,legacy-exponential,$(1),exponential_13,$(SIM2REAL)/ours/$(1)/shade.yaml,$(call cases_posed,$(1)))
endef
$(foreach o,$(CASES_OBJECTS),$(eval $(call paper_objects,$(o))))

# All methods are evaluated like TacIPC.
PAPER_METHODS := $(PAPER_TACCHI_LIT) $(PAPER_TACCHI:%=%-our-light) depth-based-our-light legacy-ours legacy-tacchi legacy-depth-based legacy-exponential
paper_images = $(foreach o,$(CASES_OBJECTS),$(foreach i,$(CASES_IMAGES_$(o)),$(PAPER_REAL)/simulated/$(1)/$(o)/$(i).png))
$(foreach m,$(PAPER_METHODS),$(eval $(PAPER_REAL)/metrics/$(m)/metrics.yaml: $(foreach o,$(CASES_OBJECTS),$(PAPER_REAL)/simulated/$(m)/$(o)/shade.yaml)))
$(PAPER_REAL)/metrics/%/metrics.yaml: $(SIM2REAL)/cases/cases.yaml $(always) | build
	$(call run,metrics,--config $(SIM2REAL)/cases/metrics.yaml --images $(call paper_images,$*) --reference $(CASES_REAL))

# Rows of the table that rivals.mk makes.
PAPER_RIVALS := $(filter-out $(PAPER_METHODS) ours depth-based background,$(call rivals_methods,$(PAPER_TABLE),name))
PAPER_SCORES := $(foreach m,ours depth-based background,$(SIM2REAL)/metrics/$(m)/metrics.yaml) \
  $(foreach m,$(PAPER_METHODS),$(PAPER_REAL)/metrics/$(m)/metrics.yaml) \
  $(foreach m,$(PAPER_RIVALS),$(RIVALS)/metrics/$(m)/metrics.yaml)
# Cost of an image for these rows, with Tacchi's own presses of the same objects.
paper_presses = $(foreach o,$(CASES_OBJECTS),$(PAPER_REAL)/$(1)/objects/$(o))
$(PAPER_REAL)/speed/bench_rivals.yaml: $(rivals_timed) $(foreach t,$(PAPER_TACCHI_LIT),$(addsuffix /mpm.yaml,$(call paper_presses,$(t)))) \
    | $(PAPER_SCORES) build-bench-rivals
	$(call rivals_speed,--mpm $(foreach t,$(PAPER_TACCHI_LIT),$(addprefix $(t)=,$(call paper_presses,$(t)))))
ifneq ($(filter paper-real,$(MAKECMDGOALS)),)
$(RIVALS)/speed/bench_rivals.yaml: | $(PAPER_SCORES)
$(if $(RIVALS_TABLE),$(eval $(PAPER_REAL)/speed/bench_rivals.yaml: | $(RIVALS)/tabulate.yaml))
endif
$(PAPER_REAL)/tabulate.yaml: $(PAPER_TABLE) $(PAPER_SCORES) $(PAPER_REAL)/speed/bench_rivals.yaml $(always) | build
	$(call run,tabulate,--config $(PAPER_TABLE) --speeds $(PAPER_REAL)/speed/image_speeds.csv --pictures $(addprefix photograph=,$(CASES_REAL)) \
	  $(foreach m,ours depth-based,$(addprefix $(m)=,$(call sim2real_images,$(m)))) \
	  $(foreach m,$(PAPER_METHODS),$(addprefix $(m)=,$(call paper_images,$(m)))) $(foreach m,$(PAPER_RIVALS),$(call rivals_pictures,$(m))) \
	  --samples $(foreach m,ours depth-based background,$(m)=$(SIM2REAL)/metrics/$(m)/samples.csv) \
	  $(foreach m,$(PAPER_METHODS),$(m)=$(PAPER_REAL)/metrics/$(m)/samples.csv) \
	  $(foreach m,$(PAPER_RIVALS),$(m)=$(RIVALS)/metrics/$(m)/samples.csv))

paper-real: ## studies: Table I (a) of the paper on the photographs of sim2real: six simulators, fitted light and published optics (needs SHARED)
paper-real: $(PAPER_REAL)/tabulate.yaml $(if $(RIVALS_TABLE),rivals)
	@$(if $(PAPER_MORE),$(call make_again,REBUILD=no CASES=$(PAPER_MORE) rivals))
	@echo; echo "Look at $(PAPER_REAL)/table.md and $(PAPER_REAL)/paper_results"

# Additional photographs with unknown depths: without Tacchi, whose runs need the depths.
PAPER_MORE := $(if $(and $(filter gelsight_sim2real,$(cases_name)),$(wildcard $(SHARED)/data/gsmini_balls)),configs/studies/sim2real/gsmini_balls.yaml)

# Part of the paper's page (paper.mk).
$(eval $(call paper_fragment,real,$(PAPER_REAL)/tabulate.yaml,yes))
paper-fragment-real: paper-real-folders
.PHONY: paper-real-folders
paper-real-folders:
	$(call paper_folders,real,$(PAPER_REAL) $(RIVALS) $(addprefix $(SIM2REAL)/,cases gel ball objects rest calibrate rival ours depth-based background metrics))
else
paper-real:
endif
