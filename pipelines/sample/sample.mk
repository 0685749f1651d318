# One object of the user's own: make -f Makefile.data sample OBJECT=path.stl [variables below]

SENSOR   ?= mctac#            a file of configs/sensors
MESH     ?= adaptive_0250um#  a file of configs/gels
PRESS    ?= default#          a file of configs/press
FRICTION ?=#                  friction coefficient (default: from PRESS)
MOTION   ?= press#            press and the following motions: shear twist tilt hold release, joined by +; or a file.yaml with motion and placement
DEPTH_MM ?= 0.5#              depth of the lowest point
FORCE_N  ?=#                  press until this force instead of a depth
DENSITY  ?= 7800#             density of the object, kg/m3, for FORCE_N
STEPS    ?= 5#                frames of the press
SHEAR_MM  ?= 0.5#             sideways travel
DIRECTION ?= 0#               direction of shear and tilt: degrees from x (image right) towards y (image down)
TWIST_DEG ?= 10#              rotation about z
TILT_DEG  ?= 5#               tilt angle
MOVE_STEPS ?= 20#             frames of each motion after the press
UNIT     ?= auto#             unit of the object's file: m, cm, mm, um, in (default: from its format or name, part_cm.stl; otherwise mm)
SCALE    ?= 1#                scale of the object; fit: the side that presses fills nine tenths of the sensor's field of view
SHEET_MM ?=#                  thickness of a plate made of each open surface (default: one side of it is pressed)
WRAP     ?=#                  yes, or a radius in mm: press a closed surface wrapped around the mesh: it keeps undercuts,
                            # and bridges gaps that a ball of that radius does not get into
UP       ?=#                  side of the object that looks away from the gel: +x -x +y -y +z -z
FACE     ?=#                  side that presses (default: opposite of UP, otherwise that of most relief in the field of view)
ROTATE   ?= 0#                degrees about the sensor's z axis
CENTER   ?= 0,0#              position of the bounding box's centre on the gel, mm (default: most relief in the middle, if no side is named)
TURNS    ?= 0 90#             gallery: rotations of each side about the sensor's z axis, degrees: 0 90 180 270
NAME     ?= $(basename $(notdir $(OBJECT)))# name of the sample
SAMPLE_VARIABLES := SENSOR MESH PRESS FRICTION MOTION DEPTH_MM FORCE_N DENSITY STEPS SHEAR_MM DIRECTION TWIST_DEG TILT_DEG MOVE_STEPS \
  UNIT SCALE SHEET_MM WRAP UP FACE ROTATE CENTER TURNS NAME
given := $(foreach v,$(SAMPLE_VARIABLES),$(if $(filter command,$(firstword $(origin $(v)))),$(v)))# variables given on the command line
$(foreach v,$(SAMPLE_VARIABLES),$(eval override $(v) := $(strip $($(v)))))

.PHONY: sample track gallery
$(foreach g,sample track gallery mpm-sample,$(eval packages_for_$(g) := $(if $(filter-out no,$(WRAP)),wrap)))
ifdef OBJECT
$(call check_name,OBJECT)
$(call check_inside,NAME)
ifeq ($(wildcard $(OBJECT)),)
  $(error OBJECT: $(OBJECT) does not exist)
endif
ifeq ($(wildcard configs/sensors/$(SENSOR).yaml),)
  $(error SENSOR: there is no configs/sensors/$(SENSOR).yaml (there are: $(SENSORS)))
endif
ifeq ($(wildcard configs/gels/$(MESH).yaml),)
  $(error MESH: there is no configs/gels/$(MESH).yaml (there are: $(MESHES)))
endif
SAMPLE := $(OUT)/sample/$(NAME)

# The motion: a file, or words.
MOVES := shear twist tilt hold release
$(call check_name,MOTION)
motion_file := $(filter %.yaml,$(MOTION))
motion_paths :=
ifneq ($(motion_file),)
  ifeq ($(wildcard $(motion_file)),)
    $(error MOTION: $(motion_file) does not exist)
  endif
  useless := $(filter DEPTH_MM FORCE_N DENSITY STEPS SHEAR_MM DIRECTION TWIST_DEG TILT_DEG MOVE_STEPS FACE ROTATE CENTER,$(given))
else
  asked := $(subst +, ,$(MOTION))
  moves := $(if $(filter press,$(firstword $(asked))),$(wordlist 2,$(words $(asked)),$(asked)),$(asked))
  unknown := $(if $(asked),$(filter-out $(MOVES),$(moves)),nothing)
  ifneq ($(unknown),)
    $(error MOTION: '$(firstword $(unknown))' is none of press, $(subst $(space),$(comma) ,$(MOVES)) (several joined by +) and no file.yaml)
  endif
  ifneq ($(and $(FORCE_N),$(filter DEPTH_MM,$(given))),)
    $(error DEPTH_MM, FORCE_N: say one of them)
  endif
  useless := $(filter $(if $(filter shear,$(moves)),,SHEAR_MM) $(if $(filter shear tilt,$(moves)),,DIRECTION) $(if $(filter twist,$(moves)),,TWIST_DEG) \
    $(if $(filter tilt,$(moves)),,TILT_DEG) $(if $(moves),,MOVE_STEPS) $(if $(FORCE_N),,DENSITY),$(given))
endif
ifneq ($(useless),)
  $(error $(firstword $(useless)): has no effect with MOTION=$(MOTION)$(if $(filter DENSITY,$(firstword $(useless))), without FORCE_N))
endif

ifeq ($(wildcard configs/press/$(PRESS).yaml),)
  $(error PRESS: there is no configs/press/$(PRESS).yaml (there are: $(basename $(notdir $(wildcard configs/press/*.yaml)))))
endif
ifneq ($(FRICTION),)
  $(call check_name,FRICTION)
endif
sample_spec  := $(or $(motion_file),$(SAMPLE)/sample.yaml)
press_config := $(if $(FRICTION),$(SAMPLE)/press_config.yaml,configs/press/$(PRESS).yaml)

side_given  := $(or $(FACE),$(if $(filter +%,$(UP)),$(patsubst +%,-%,$(UP)),$(patsubst -%,+%,$(UP))))
choose_side := $(if $(motion_file)$(side_given),,yes)
# Configuration files from the variables, rewritten only if they change.
press_phase   = {kind: press, $(if $(FORCE_N),force_n: $(FORCE_N),depth_mm: $(DEPTH_MM)), steps: $(STEPS)}
shear_phase   = {kind: shear, direction_deg: $(DIRECTION), distance_mm: $(SHEAR_MM), steps: $(MOVE_STEPS)}
twist_phase   = {kind: twist, angle_deg: $(TWIST_DEG), steps: $(MOVE_STEPS)}
tilt_phase    = {kind: tilt, direction_deg: $(DIRECTION), angle_deg: $(TILT_DEG), steps: $(MOVE_STEPS)}
hold_phase    = {kind: hold, steps: $(MOVE_STEPS)}
release_phase = {kind: release, steps: $(MOVE_STEPS)}
define sample_yaml
placement:
  rotate_deg: $(ROTATE)
  center_mm: [$(CENTER)]
$(if $(FACE),  face: "$(FACE)")
$(if $(FORCE_N),object: {density_kg_m3: $(DENSITY)})
motion: $(if $(moves),,$(press_phase))
$(if $(moves),  - $(press_phase)$(foreach m,$(moves),$(newline)  - $($(m)_phase)))
endef
define object_yaml
unit: $(UNIT)
scale: $(SCALE)
$(if $(UP),up: "$(UP)")
$(if $(SHEET_MM),sheet_thickness_mm: $(SHEET_MM))
$(if $(filter-out no,$(WRAP)),wrap: {$(if $(filter-out yes,$(WRAP)),alpha_mm: $(WRAP))})
height_field:
endef
# Pressing side: that of most relief in the sensor's field of view, unless a variable or the motion's file selects one.
# A mesh that no repair closes is pressed as the solid of that side.
pressed_side = $(if $(choose_side),most_relief,$(if $(motion_file),$(side_of_motion),$(side_given)))
side_of_motion = $$($(BIN)/tacipc get $(motion_file) placement.face --default "$(or $(side_given),-z)")
# Path files of a motion; errors in them or in FRICTION are reported before anything is made.
ifneq ($(motion_file)$(FRICTION),)
$(SAMPLE)/paths.mk: $(motion_file) $(if $(FRICTION),$(SAMPLE)/press_config.yaml) FORCE | build
	$(call replace_if_changed_by,bash pipelines/sample/motion_paths.sh $(BIN)/tacipc $(motion_file))
include $(SAMPLE)/paths.mk
endif
# Paths of the chosen files: another object, sensor, mesh, press or motion under the same name must redo the sample,
# regardless of its age.
choice_yaml = {object: $(abspath $(OBJECT)), sensor: $(SENSOR), mesh: $(MESH), press: $(PRESS), friction: $(or $(FRICTION),as said), \
  motion: $(or $(abspath $(motion_file)),as said)}
$(SAMPLE)/$(if $(choose_side),asked,sample).yaml: FORCE
	$(call replace_if_changed,$(sample_yaml))
$(SAMPLE)/object.yaml: $(motion_file) FORCE | build
	$(call replace_if_changed_by,printf '%s\n' '$(subst $(newline),' ',$(object_yaml))' "  side: \"$(pressed_side)\"")
$(SAMPLE)/press_config.yaml: configs/press/$(PRESS).yaml FORCE | build
	$(call replace_if_changed_by,$(BIN)/tacipc set $< 'friction.coefficient=$(FRICTION)')
$(SAMPLE)/choice.txt: FORCE
	$(call replace_if_changed,$(choice_yaml))
	$(if $(motion_file),@rm -f $(SAMPLE)/sample.yaml)
$(SAMPLE)/wrap/wrap.yaml: $(OBJECT) $(SAMPLE)/object.yaml $(SAMPLE)/choice.txt $(always) | build
	$(wrap_is_built)
	$(call run,wrap,--mesh $(OBJECT) --object $(SAMPLE)/object.yaml)
# Input of decimate: the mesh, or the wrap with an object file of its own.
wrap_made = $(if $(filter-out no,$(WRAP)),$(SAMPLE)/wrap/$(1),$(2))
$(SAMPLE)/object/decimate.yaml: $(OBJECT) $(SAMPLE)/object.yaml $(call wrap_made,wrap.yaml) $(SAMPLE)/choice.txt configs/objects/decimate/default.yaml \
    configs/sensors/$(SENSOR).yaml $(always) | build
	$(call run,decimate,--mesh $(call wrap_made,object.ply,$(OBJECT)) --object $(call wrap_made,object.yaml,$(SAMPLE)/object.yaml) \
	  --config configs/objects/decimate/default.yaml --sensor configs/sensors/$(SENSOR).yaml)
ifdef choose_side
# Also the position of most relief, if the object is neither turned nor placed.
side := $(BIN)/tacipc get $(SAMPLE)/object/decimate.yaml summary.sides
$(SAMPLE)/sample.yaml: $(SAMPLE)/asked.yaml $(SAMPLE)/object/decimate.yaml
	$(call replace_if_changed_by,$(BIN)/tacipc set $< "+placement.face=$$($(side).pressed)" \
	  $(if $(filter CENTER ROTATE,$(given)),,"placement.center_mm=[$$($(side).center_mm[0]), $$($(side).center_mm[1])]"))
endif
# $(call chosen_rules,folder,name,motion): a sample of this object
chosen_rules = $(call sample_rules,$(1),name=$(2) object=$(SAMPLE)/object object_yaml=$(SAMPLE)/object.yaml sensor=$(SENSOR) mesh=$(MESH) \
  motion=$(3) press=$(press_config) $(addprefix after=,$(SAMPLE)/choice.txt $(motion_paths)))
$(eval $(call chosen_rules,$(SAMPLE),$(NAME),$(sample_spec)))
$(eval $(call report_rules,$(SAMPLE),$(NAME),$(SAMPLE)))

# Every frame rendered, and the printed markers tracked in the images.
$(SAMPLE)/frames/render.yaml: $(SAMPLE)/press/press.yaml configs/sensors/$(SENSOR).yaml configs/render/all_frames.yaml $(REFERENCES) $(always) | build
	$(call run,render,--press $(SAMPLE)/press --gel $(OUT)/gels/$(SENSOR)-$(MESH)/gel.msh --sensor configs/sensors/$(SENSOR).yaml \
	  --config configs/render/all_frames.yaml)
$(SAMPLE)/track/track.yaml: $(SAMPLE)/frames/render.yaml configs/render/track/default.yaml $(always) | build
	$(call run,track,--render $(SAMPLE)/frames --config configs/render/track/default.yaml)

track: $(SAMPLE)/track/track.yaml ## own: Printed markers of a sample measured in its images: OBJECT=path.stl [as of sample]
	@$(BIN)/tacipc get $< summary

sample: $(SAMPLE)/report/report.yaml ## own: One object of your own: OBJECT=path.stl [MOTION=shear|twist|release|…; see pipelines/sample/sample.mk]
	$(call look,$(SAMPLE))

# The gallery: each of the six sides at its place of most relief, in quarter turns.
ifneq ($(filter gallery,$(MAKECMDGOALS)),)
ifndef choose_side
  $(error gallery: presses all sides; leave out FACE, UP and a motion's file)
endif
ifneq ($(filter-out 0 90 180 270,$(TURNS)),)
  $(error TURNS: '$(TURNS)' must be some of 0 90 180 270)
endif
endif
GALLERY_SIDES := +x -x +y -y +z -z# sides in the order of the record
GALLERY_POSES := $(foreach s,$(GALLERY_SIDES),$(foreach t,$(TURNS),$(s)_$(t)))
$(SAMPLE)/gallery/%/sample.yaml: $(SAMPLE)/asked.yaml $(SAMPLE)/object/decimate.yaml
	$(call replace_if_changed_by,bash pipelines/sample/pose.sh $(BIN)/tacipc $^ $(subst _, ,$*))
$(foreach p,$(if $(choose_side),$(GALLERY_POSES)),$(eval $(call chosen_rules,$(SAMPLE)/gallery/$(p),$(NAME)_$(p),$(SAMPLE)/gallery/$(p)/sample.yaml)))
$(eval $(call report_rules,$(SAMPLE)/gallery,$(NAME) from all sides,$(addprefix $(SAMPLE)/gallery/,$(GALLERY_POSES))))

gallery: $(SAMPLE)/gallery/report/report.yaml ## own: One sheet of all sides of an object: OBJECT=path.stl [TURNS="0 90 180 270"; as of sample]
	$(call look,$(SAMPLE)/gallery)
else
gallery:
	@echo "gallery: say which object: make -f Makefile.data gallery OBJECT=path.stl" >&2; exit 2
track:
	@echo "track: say which object: make -f Makefile.data track OBJECT=path.stl" >&2; exit 2
sample:
	@echo "sample: say which object: make -f Makefile.data sample OBJECT=path.stl" >&2; exit 2
endif
