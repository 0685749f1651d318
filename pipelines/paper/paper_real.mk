# Table I (a) of the paper on photographs: our images, Tacchi's and the depth-based method's, each under light fitted to the
# same balls on its own membranes, then all with the optics that the rivals were published with. What sim2real.mk makes is
# used as it is; docs/sim2real.md has the protocol.
$(call uses,paper/sim2real paper/paper)

.PHONY: paper-real
ifneq ($(filter paper-real paper-fragment-real depth-rivals,$(MAKECMDGOALS)),)
PAPER_REAL := $(OUT)/paper/real/$(cases_name)
PAPER_CONFIGS := $(basename $(CASES))
PAPER_TABLE := $(PAPER_CONFIGS)/table.yaml
ifneq ($(CASES_TABLE),)
  $(error paper-real: $(CASES) tells no depths, which Tacchi's runs need)
endif
$(foreach f,$(PAPER_TABLE) $(addprefix $(PAPER_CONFIGS)/,mpm.yaml legacy_tacchi.yaml legacy_gomes_2021.yaml legacy_exponential_13.yaml),\
  $(if $(wildcard $(f)),,$(error paper-real: $(f) does not exist)))

# Tacchi's gel under the balls that calibrate, each at the place and depth that our calibration found, and under the objects
# at ours. $(call paper_mpm,folder,indenter folder)
define paper_mpm
$(1)/mpm.yaml: $(1)/motion.yaml $(2)/indenter.yaml $(PAPER_CONFIGS)/mpm.yaml $(CASES_SENSOR) | build
	$$(call run,mpm,--name $(notdir $(1)) --config $(PAPER_CONFIGS)/mpm.yaml --sensor $(CASES_SENSOR) --sample $(1)/motion.yaml \
	  --object $(2)/object.ply --object-config configs/objects/embossed.yaml)
endef
PAPER_BALLS := $(if $(CASES_LABELS),$(shell seq -f %04.0f 0 $$(($$(grep -c '[^[:space:]]' $(cases_labels)) - 1))))
paper_ball = $(PAPER_REAL)/tacchi/balls/ball_$(1)
$(foreach b,$(PAPER_BALLS),$(eval $(call paper_mpm,$(call paper_ball,$(b)),$(SIM2REAL)/ball/indenter)))
$(PAPER_REAL)/tacchi/balls/ball_%/motion.yaml: $(SIM2REAL)/calibrate/calibrate.yaml
	mkdir -p $(@D)
	mapfile -t balls < <($(BIN)/tacipc table $(<D)/balls.csv --columns x_mm,y_mm,depth_mm); read -r x y depth <<< "$${balls[10#$*]}"; \
	printf 'placement: {center_mm: [%s, %s]}\nmotion: {kind: press, depth_mm: %s, steps: 1}\n' "$$x" "$$y" "$$depth" > $@
$(PAPER_REAL)/tacchi/calibrate/calibrate.yaml: $(foreach b,$(PAPER_BALLS),$(call paper_ball,$(b))/mpm.yaml) $(foreach o,$(CASES_KNOWN),$(PAPER_REAL)/tacchi/objects/$(o)/mpm.yaml) $(CASES_CALIBRATE) | build
	$(call run,calibrate,$(calibration) --shapes $(foreach b,$(PAPER_BALLS),$(call paper_ball,$(b))/frame_0001/seen_indentation.exr) \
	  $(foreach o,$(CASES_KNOWN),$(PAPER_REAL)/tacchi/objects/$(o)/frame_$(call known_frame,$(o),0)/seen_indentation.exr))

# $(call paper_shade,method,object,light's record,record of the shapes,shapes)
define paper_shade
$(PAPER_REAL)/simulated/$(1)/$(2)/shade.yaml: $(4) $(3) | build
	$$(call run,shade,$$(call shading,$(2)) --light $(dir $(3))light.yaml --shapes $(5))
endef
# $(call paper_legacy,method,object,configuration,record of the shapes,shapes): images under the photographs' names
define paper_legacy
$(PAPER_REAL)/legacy/$(1)/$(2)/baseline.yaml: $(4) $(PAPER_CONFIGS)/legacy_$(3).yaml | build
	$$(call run,baseline,--config $(PAPER_CONFIGS)/legacy_$(3).yaml --sensor $(CASES_SENSOR) --background $(cases_background) $(5))
$(PAPER_REAL)/simulated/$(1)/$(2)/shade.yaml: $(PAPER_REAL)/legacy/$(1)/$(2)/baseline.yaml
	mkdir -p $$(@D)
	frames=($(call cases_frames,$(2),$(PAPER_REAL)/legacy/$(1)/$(2),0,tactile.png)); i=0; \
	for image in $(CASES_IMAGES_$(2)); do cp "$$$${frames[i]}" $$(@D)/$$$$image.png; i=$$$$((i + 1)); done
	touch $$@
endef
define paper_objects
$(PAPER_REAL)/tacchi/objects/$(1)/motion.yaml: $(SIM2REAL)/ours/$(1)/shade.yaml $(SIM2REAL)/cases/cases.yaml
	mkdir -p $$(@D)
	{ read -r x; read -r y; read -r yaw; } < <($(BIN)/tacipc get $$< summary.center_mm summary.yaw_deg); \
	echo "placement: {center_mm: [$$$$x, $$$$y], rotate_deg: $$$$yaw}" > $$@
	cat $(SIM2REAL)/cases/objects/$(1)/motion.yaml >> $$@
$(call paper_mpm,$(PAPER_REAL)/tacchi/objects/$(1),$(SIM2REAL)/objects/$(1)/indenter)
$(call paper_shade,tacchi,$(1),$(PAPER_REAL)/tacchi/calibrate/calibrate.yaml,$(PAPER_REAL)/tacchi/objects/$(1)/mpm.yaml,$(call cases_frames,$(1),$(PAPER_REAL)/tacchi/objects/$(1),1,seen_indentation.exr))
$(call paper_shade,tacchi-our-light,$(1),$(SIM2REAL)/calibrate/calibrate.yaml,$(PAPER_REAL)/tacchi/objects/$(1)/mpm.yaml,$(call cases_frames,$(1),$(PAPER_REAL)/tacchi/objects/$(1),1,seen_indentation.exr))
$(call paper_shade,depth-based-our-light,$(1),$(SIM2REAL)/calibrate/calibrate.yaml,$(SIM2REAL)/rival/objects/$(1)/baseline.yaml,$(call cases_frames,$(1),$(SIM2REAL)/rival/objects/$(1),0,indentation.exr))
$(call paper_legacy,legacy-ours,$(1),tacchi,$(SIM2REAL)/ours/$(1)/shade.yaml,--depth $(foreach i,$(CASES_IMAGES_$(1)),$(SIM2REAL)/ours/$(1)/depth/$(i).exr))
$(call paper_legacy,legacy-tacchi,$(1),tacchi,$(PAPER_REAL)/simulated/tacchi/$(1)/shade.yaml,--depth $(foreach i,$(CASES_IMAGES_$(1)),$(PAPER_REAL)/simulated/tacchi/$(1)/depth/$(i).exr))
$(call paper_legacy,legacy-depth-based,$(1),gomes_2021,$(SIM2REAL)/ours/$(1)/shade.yaml,$(call cases_posed,$(1)))
$(call paper_legacy,legacy-exponential,$(1),exponential_13,$(SIM2REAL)/ours/$(1)/shade.yaml,$(call cases_posed,$(1)))
endef
$(foreach o,$(CASES_OBJECTS),$(eval $(call paper_objects,$(o))))

# All of them scored as ours are.
PAPER_METHODS := tacchi tacchi-our-light depth-based-our-light legacy-ours legacy-tacchi legacy-depth-based legacy-exponential
paper_images = $(foreach o,$(CASES_OBJECTS),$(foreach i,$(CASES_IMAGES_$(o)),$(PAPER_REAL)/simulated/$(1)/$(o)/$(i).png))
$(foreach m,$(PAPER_METHODS),$(eval $(PAPER_REAL)/metrics/$(m)/metrics.yaml: $(foreach o,$(CASES_OBJECTS),$(PAPER_REAL)/simulated/$(m)/$(o)/shade.yaml)))
$(PAPER_REAL)/metrics/%/metrics.yaml: $(SIM2REAL)/cases/cases.yaml | build
	$(call run,metrics,--config $(SIM2REAL)/cases/metrics.yaml --images $(call paper_images,$*) --reference $(CASES_REAL))

PAPER_SCORES := $(foreach m,ours depth-based background,$(SIM2REAL)/metrics/$(m)/metrics.yaml) $(foreach m,$(PAPER_METHODS),$(PAPER_REAL)/metrics/$(m)/metrics.yaml)
$(PAPER_REAL)/tabulate.yaml: $(PAPER_TABLE) $(PAPER_SCORES) | build
	$(call run,tabulate,--config $(PAPER_TABLE) --pictures $(addprefix photograph=,$(CASES_REAL)) \
	  $(foreach m,ours depth-based,$(addprefix $(m)=,$(call sim2real_images,$(m)))) $(foreach m,$(PAPER_METHODS),$(addprefix $(m)=,$(call paper_images,$(m)))) \
	  --samples $(foreach m,ours depth-based background,$(m)=$(SIM2REAL)/metrics/$(m)/samples.csv) $(foreach m,$(PAPER_METHODS),$(m)=$(PAPER_REAL)/metrics/$(m)/samples.csv))

paper-real: $(PAPER_REAL)/tabulate.yaml ## studies: Table I (a) of the paper on the photographs of sim2real: three simulators, fitted light and published optics (needs SHARED)
	@echo; echo "Look at $(PAPER_REAL)/table.md and $(PAPER_REAL)/paper_results"

# On the page of the paper (paper.mk).
$(eval $(call paper_fragment,real,$(PAPER_REAL)/tabulate.yaml,yes))
paper-fragment-real: paper-real-folders
.PHONY: paper-real-folders
paper-real-folders:
	$(call paper_folders,real,$(PAPER_REAL) $(addprefix $(SIM2REAL)/,cases gel ball objects rest calibrate rival ours depth-based background metrics))
else
paper-real:
endif
