# Compares simulations with photographs: make -f Makefile.data sim2real
# CASES=configs/studies/sim2real/gelsight_sim2real.yaml
# The file lists the photographs (below SHARED), objects, depths and positions. Images of TacIPC and of the depth-based
# method under light fitted to the same balls, and the background alone, are evaluated alike; docs/sim2real.md has the
# table.

CASES ?= configs/studies/sim2real/gelsight_sim2real.yaml#  the benchmark
override CASES := $(strip $(CASES))
cases_name := $(basename $(notdir $(CASES)))
SIM2REAL := $(OUT)/sim2real/$(cases_name)

.PHONY: sim2real sim2real-page
ifneq ($(filter sim2real sim2real-page rivals paper-real paper-fragment-real depth-rivals depth-networks,$(MAKECMDGOALS)),)
$(call check_name,CASES)
$(call check_name,SHARED)
ifeq ($(wildcard $(CASES)),)
  $(error CASES: $(CASES) does not exist)
endif
ifeq ($(wildcard $(SHARED)),)
  $(error SHARED: $(SHARED) does not exist; the photographs are looked for there)
endif

# Inputs of the stages are made from the single file first, then make restarts with its variables. A table of contact
# circles that the file names lies among the data.
include $(SIM2REAL)/cases/cases.mk
CASES_TABLE := $(addprefix $(SHARED)/,$(CASES_CIRCLES))
cases_circles := $(addprefix --circles ,$(CASES_TABLE))
$(SIM2REAL)/cases/cases.yaml: $(CASES) $(CASES_TABLE) $(always) | build
	@circles=$$($(BIN)/tacipc get $< circles --default ''); table=$(SHARED)/$$($(BIN)/tacipc get $< data --default '')/$$circles; \
	[ -z "$$circles" ] || [ -e "$$table" ] || { echo "CASES: $< names $$table, which does not exist" >&2; exit 1; }; \
	$(call run,cases,--config $< $${circles:+--circles "$$table"})
$(SIM2REAL)/cases/cases.mk: $(SIM2REAL)/cases/cases.yaml ;
cases_data = $(SHARED)/$(1)
cases_photograph = $(call cases_data,$(CASES_PHOTOGRAPH_$(1)))
cases_background := $(if $(CASES_TABLE),$(SIM2REAL)/rest/background.png,$(call cases_data,$(CASES_BACKGROUND)))
cases_labels := $(if $(CASES_TABLE),$(SIM2REAL)/cases/labels.txt,$(call cases_data,$(CASES_LABELS)))
# Contacts of the ball that calibrates need no press of their own.
cases_press = $(SIM2REAL)/$(if $(CASES_TABLE),ball,objects/$(1))
# An object at the position of TacIPC's fit, frame after frame; and a file of each of these frames, one per photograph:
# $(call cases_frames,object,folder,first frame,file)
cases_posed  = --object $(call cases_press,$(1))/indenter/object.ply --pose $(SIM2REAL)/ours/$(1)/object_pose.npy
cases_frames = $(foreach k,$(shell seq -f %04.0f $(3) $$(($(3) + $(words $(CASES_IMAGES_$(1))) - 1))),$(2)/frame_$(k)/$(4))
CASES_ALL = $(foreach o,$(CASES_OBJECTS),$(CASES_IMAGES_$(o)))

$(SIM2REAL)/gel/tetmesh.yaml: $(CASES_SENSOR) $(CASES_MESH) $(always) | build
	$(call run,tetmesh,--sensor $(CASES_SENSOR) --config $(CASES_MESH))

# Indenters and their presses; $(call sim2real_press,folder,settings,mesh)
define sim2real_press
$(1)/indenter/indenter.yaml: $(2)/indenter.yaml $(3) $(always) | build
	$$(call run,indenter,--config $(2)/indenter.yaml $(addprefix --mesh ,$(3)))
$(1)/press/press.yaml: $(1)/indenter/indenter.yaml $(2)/motion.yaml $(SIM2REAL)/gel/tetmesh.yaml $(CASES_SENSOR) $(CASES_PRESS) $(always) | build
	$$(call run,press,--name $(notdir $(1)) --object $(1)/indenter/object.ply --object-config configs/objects/embossed.yaml \
	  --gel $(SIM2REAL)/gel/gel.msh --sensor $(CASES_SENSOR) --config $(CASES_PRESS) --sample $(2)/motion.yaml)
$(2)/indenter.yaml $(2)/motion.yaml: $(SIM2REAL)/cases/cases.yaml ;
endef
$(eval $(call sim2real_press,$(SIM2REAL)/ball,$(SIM2REAL)/cases/ball,))
$(if $(CASES_TABLE),,$(foreach o,$(CASES_OBJECTS),$(eval $(call sim2real_press,$(SIM2REAL)/objects/$(o),$(SIM2REAL)/cases/objects/$(o),\
  $(addprefix $(SHARED)/,$(CASES_MESH_$(o)))))))

# If there is no photograph without contact, the background is the median of those that calibrate, away from their
# contacts.
$(SIM2REAL)/rest/background.yaml: $(SIM2REAL)/cases/cases.yaml $(always) | build
	$(call run,background,--config $(SIM2REAL)/cases/background.yaml --labels $(SIM2REAL)/cases/labels.txt --photographs $(call cases_data,$(CASES_PHOTOGRAPHS)))
background_record := $(if $(CASES_TABLE),$(SIM2REAL)/rest/background.yaml)

# The light on TacIPC's membranes, and on those of the depth-based method under the same balls.
calibration_balls = --config $(CASES_CALIBRATE) --sensor $(CASES_SENSOR) --background $(cases_background) \
  --photographs $(call cases_data,$(CASES_PHOTOGRAPHS)) --labels $(cases_labels)
calibration = $(calibration_balls) $(if $(CASES_KNOWN),--objects $(SIM2REAL)/cases/known_objects.yaml)
known_frame = $(shell printf '%04d' $$(($(CASES_KNOWN_FRAME_$(1)) + $(2))))
$(SIM2REAL)/calibrate/calibrate.yaml: $(SIM2REAL)/ball/press/press.yaml $(foreach o,$(CASES_KNOWN),$(SIM2REAL)/objects/$(o)/press/press.yaml) \
    $(background_record) $(CASES_CALIBRATE) $(CASES_SENSOR) $(always) | build
	$(call run,calibrate,$(calibration) --press $(SIM2REAL)/ball/press --gel $(SIM2REAL)/gel/gel.msh \
	  $(foreach o,$(CASES_KNOWN),--object-press $(o)=$(SIM2REAL)/objects/$(o)/press))
$(SIM2REAL)/rival/balls/baseline.yaml: $(SIM2REAL)/calibrate/calibrate.yaml $(CASES_BASELINE) $(always) | build
	$(call run,baseline,--config $(CASES_BASELINE) --sensor $(CASES_SENSOR) --object $(SIM2REAL)/ball/indenter/object.ply \
	  --pose $(SIM2REAL)/calibrate/ball_poses.npy)
$(SIM2REAL)/rival/calibrate/calibrate.yaml: $(SIM2REAL)/rival/balls/baseline.yaml \
    $(foreach o,$(CASES_KNOWN),$(SIM2REAL)/rival/objects/$(o)/baseline.yaml) $(CASES_CALIBRATE) $(always) | build
	$(call run,calibrate,$(calibration) --shapes $(SIM2REAL)/rival/balls/frame_*/indentation.exr \
	  $(foreach o,$(CASES_KNOWN),$(SIM2REAL)/rival/objects/$(o)/frame_$(call known_frame,$(o),-1)/indentation.exr))

# Images of one object: TacIPC's, then the depth-based method's at the same position and depth.
shading = --config $(SIM2REAL)/cases/objects/$(1)/shade.yaml --sensor $(CASES_SENSOR) --background $(cases_background)
# Position of the images: determined by contacts, or fitted to one photograph.
placing = $(if $(CASES_TABLE),--contact $(SIM2REAL)/calibrate/contact.yaml,--photograph $(call cases_photograph,$(CASES_FIT_$(1))))
define sim2real_object
$(SIM2REAL)/ours/$(1)/shade.yaml: $(call cases_press,$(1))/press/press.yaml $(SIM2REAL)/calibrate/calibrate.yaml $(always) | build
	$$(call run,shade,$$(call shading,$(1)) --light $(SIM2REAL)/calibrate/light.yaml --press $(call cases_press,$(1))/press \
	  --gel $(SIM2REAL)/gel/gel.msh $$(call placing,$(1)) \
	  $(if $(filter $(1),$(CASES_KNOWN)),$$$$(find $(SIM2REAL)/calibrate -path '*/relief/$(1).exr' -printf '--relief %p')))
$(SIM2REAL)/rival/objects/$(1)/baseline.yaml: $(SIM2REAL)/ours/$(1)/shade.yaml $(CASES_BASELINE) $(always) | build
	$$(call run,baseline,--config $(CASES_BASELINE) --sensor $(CASES_SENSOR) $(call cases_posed,$(1)))
$(SIM2REAL)/depth-based/$(1)/shade.yaml: $(SIM2REAL)/rival/objects/$(1)/baseline.yaml $(SIM2REAL)/rival/calibrate/calibrate.yaml $(always) | build
	$$(call run,shade,$$(call shading,$(1)) --light $(SIM2REAL)/rival/calibrate/light.yaml \
	  --shapes $(SIM2REAL)/rival/objects/$(1)/frame_*/indentation.exr)
$(SIM2REAL)/background/$(1)/shade.yaml: $(SIM2REAL)/cases/cases.yaml $(background_record) | build
	mkdir -p $$(@D)
	for image in $(CASES_IMAGES_$(1)); do cp $(cases_background) $$(@D)/$$$$image.png; done
	touch $$@
endef
$(foreach o,$(CASES_OBJECTS),$(eval $(call sim2real_object,$(o))))

# $(call sim2real_images,method): in the order of the photographs
sim2real_images = $(foreach o,$(CASES_OBJECTS),$(foreach i,$(CASES_IMAGES_$(o)),$(SIM2REAL)/$(1)/$(o)/$(i).png))
CASES_REAL = $(foreach i,$(CASES_ALL),$(call cases_photograph,$(i)))
$(foreach m,ours depth-based background,$(eval $(SIM2REAL)/metrics/$(m)/metrics.yaml: $(foreach o,$(CASES_OBJECTS),$(SIM2REAL)/$(m)/$(o)/shade.yaml)))
$(SIM2REAL)/metrics/%/metrics.yaml: $(SIM2REAL)/cases/cases.yaml $(always) | build
	$(call run,metrics,--config $(SIM2REAL)/cases/metrics.yaml --images $(call sim2real_images,$*) --reference $(CASES_REAL))

SIM2REAL_METHODS := ours depth-based background
$(SIM2REAL)/comparison/tabulate.yaml: configs/studies/sim2real/comparison.yaml $(CASES) $(SIM2REAL_METHODS:%=$(SIM2REAL)/metrics/%/metrics.yaml) \
    $(always) | build
	$(call run,tabulate,--config $< --benchmark $(CASES) $(cases_circles) --samples $(foreach m,$(SIM2REAL_METHODS),$(m)=$(SIM2REAL)/metrics/$(m)/samples.csv) \
	  --pictures $(addprefix photograph=,$(CASES_REAL)) $(foreach m,ours depth-based,$(addprefix $(m)=,$(call sim2real_images,$(m)))))

# docs/sim2real.md has marks for the tables of the shipped benchmarks.
sim2real-page: $(SIM2REAL)/comparison/tabulate.yaml
	@! grep -qsxF '<!-- $(cases_name) -->' docs/sim2real.md || $(call fill_docs,sim2real.md,$(cases_name)=$(SIM2REAL)/comparison/table.md)
	@echo; echo "Look at $(SIM2REAL)/comparison/sheet.png (photograph | ours | twice the difference | depth-based) and table.md"

sim2real: sim2real-page ## studies: Simulated images against photographs: CASES=configs/studies/sim2real/gelsight_sim2real.yaml (three minutes; needs SHARED)
	$(call holds,$(SIM2REAL)/comparison/tabulate.yaml)
else
sim2real sim2real-page:
endif
