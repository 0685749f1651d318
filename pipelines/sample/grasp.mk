# Two sensors grip, hold and lift a user's object: make -f Makefile.data grasp OBJECT=path.stl [MASS_G=80 FORCE_N=5 and
# below]
# SENSOR, MESH, PRESS, FRICTION, UNIT, SCALE, WRAP, FORCE_N and NAME have the same meaning as for `sample`.
$(call uses,sample/sample)

MASS_G  ?= 80#      mass of the object, g
TURN    ?=#         rotation of the object about the vertical before the grip, degrees (0)
GRIP    ?=#         grip relative to its centre of mass, mm, along its own axes (0,0,0). Without TURN and GRIP, a grasp is drawn
SEED ?= 1#    seed of the drawn grasp
LIFT_MM ?= 10#      height of the lift, mm
LIFT_STEPS ?= 20#   frames of the lift: 0.2 s with time steps of 10 ms
GRASP   ?=#         a file of your own (docs/grasp.md) that replaces all these and FORCE_N
# Variables given on the command line.
grasp_given := $(foreach v,MASS_G TURN GRIP SEED LIFT_MM LIFT_STEPS,$(if $(filter command,$(firstword $(origin $(v)))),$(v))) $(filter FORCE_N,$(given))
$(foreach v,MASS_G TURN GRIP SEED LIFT_MM LIFT_STEPS GRASP,$(eval override $(v) := $(strip $($(v)))))

.PHONY: grasp
programs_for_grasp := decimate tetmesh press render report tacipc $(if $(filter-out no,$(WRAP)),wrap)
packages_for_grasp := $(if $(filter-out no,$(WRAP)),wrap)
ifneq ($(and $(filter grasp,$(MAKECMDGOALS)),$(OBJECT)),)
GRASPED := $(OUT)/grasp/$(NAME)
ifneq ($(GRASP),)
  ifeq ($(wildcard $(GRASP)),)
    $(error GRASP: $(GRASP) does not exist)
  endif
  ifneq ($(strip $(grasp_given)),)
    $(error $(firstword $(grasp_given)): has no effect with GRASP=$(GRASP))
  endif
endif
useless := $(filter MOTION DEPTH_MM DENSITY STEPS SHEAR_MM DIRECTION TWIST_DEG TILT_DEG MOVE_STEPS UP FACE ROTATE CENTER TURNS SHEET_MM,$(given))
ifneq ($(useless),)
  $(error $(firstword $(useless)): has no effect on a grasp$(if $(filter ROTATE,$(firstword $(useless))), (TURN turns the object about the vertical)))
endif
ifneq ($(and $(TURN)$(GRIP),$(filter SEED,$(grasp_given))),)
  $(error SEED: has no effect where TURN or GRIP say how the object is gripped)
endif
# The grasp given by the variables, or the one nearest to the centre of mass among a hundred drawn grasps.
grasp_chosen = turn_deg: $(or $(TURN),0), grip_mm: [$(or $(GRIP),0$(comma)0$(comma)0)]
grasp_drawn  = draw: {seed: $(SEED), best_of: 100, upright: true}
define grasp_yaml
fingers: {$(if $(TURN)$(GRIP),$(grasp_chosen),$(grasp_drawn))}
object: {mass_g: $(MASS_G)}
motion:
  - {kind: close, force_n: $(or $(FORCE_N),5), steps: 10}
  - {kind: hold, steps: 4}
  - {kind: lift, distance_mm: $(LIFT_MM), steps: $(LIFT_STEPS)}
  - {kind: hold, steps: 6}
endef
define grasped_yaml
unit: $(UNIT)
scale: $(SCALE)
$(if $(filter-out no,$(WRAP)),wrap: {$(if $(filter-out yes,$(WRAP)),alpha_mm: $(WRAP))})
endef
grasp_spec   := $(or $(GRASP),$(GRASPED)/grasp.yaml)
grasp_config := $(if $(FRICTION),$(GRASPED)/press_config.yaml,configs/press/$(PRESS).yaml)
grasp_gel    := $(OUT)/gels/$(SENSOR)-$(MESH)
grasp_made    = $(if $(filter-out no,$(WRAP)),$(GRASPED)/wrap/$(1),$(2))
grasp_choice  = {object: $(abspath $(OBJECT)), sensor: $(SENSOR), mesh: $(MESH), press: $(PRESS), grasp: $(abspath $(GRASP))}
$(GRASPED)/grasp.yaml: FORCE
	$(call replace_if_changed,$(grasp_yaml))
$(GRASPED)/object.yaml: FORCE
	$(call replace_if_changed,$(grasped_yaml))
$(GRASPED)/choice.txt: FORCE
	$(call replace_if_changed,$(grasp_choice))
$(GRASPED)/press_config.yaml: configs/press/$(PRESS).yaml FORCE | build
	$(call replace_if_changed_by,$(BIN)/tacipc set $< 'friction.coefficient=$(FRICTION)')
$(GRASPED)/wrap/wrap.yaml: $(OBJECT) $(GRASPED)/object.yaml $(GRASPED)/choice.txt $(always) | build
	$(wrap_is_built)
	$(call run,wrap,--mesh $(OBJECT) --object $(GRASPED)/object.yaml)
$(GRASPED)/object/decimate.yaml: $(OBJECT) $(GRASPED)/object.yaml $(call grasp_made,wrap.yaml) $(GRASPED)/choice.txt \
    configs/objects/decimate/default.yaml configs/sensors/$(SENSOR).yaml $(always) | build
	$(call run,decimate,--mesh $(call grasp_made,object.ply,$(OBJECT)) --object $(call grasp_made,object.yaml,$(GRASPED)/object.yaml) \
	  --config configs/objects/decimate/default.yaml --sensor configs/sensors/$(SENSOR).yaml)
$(GRASPED)/press.yaml: $(GRASPED)/object/decimate.yaml $(grasp_gel)/tetmesh.yaml configs/sensors/$(SENSOR).yaml $(grasp_config) $(grasp_spec) \
    $(GRASPED)/choice.txt $(always) | build
	$(call run,press,--name $(NAME) --object $(GRASPED)/object/object.ply --gel $(grasp_gel)/gel.msh --sensor configs/sensors/$(SENSOR).yaml \
	  --config $(grasp_config) --sample $(grasp_spec))
$(GRASPED)/left/render/render.yaml $(GRASPED)/right/render/render.yaml: $(GRASPED)/%/render/render.yaml: $(GRASPED)/press.yaml \
    configs/sensors/$(SENSOR).yaml configs/render/all_frames.yaml $(REFERENCES) $(always) | build
	$(call run,render,--press $(GRASPED)/$*/press --gel $(grasp_gel)/gel.msh --sensor configs/sensors/$(SENSOR).yaml --config configs/render/all_frames.yaml)
$(GRASPED)/report/report.yaml: $(GRASPED)/left/render/render.yaml $(GRASPED)/right/render/render.yaml | build
	$(call run,report,--title "$(NAME)" --grasp $(GRASPED))

grasp: ## own: Two sensors grip, hold and lift an object: OBJECT=path.stl [MASS_G=80 FORCE_N=5 FRICTION=0.7 LIFT_MM=10 SEED=1; TURN= GRIP=; GRASP=your.yaml]
grasp: $(GRASPED)/report/report.yaml
	@$(BIN)/tacipc get $(GRASPED)/press.yaml summary.outcome
	@echo; echo "Look at $(GRASPED)/report/index.html, $(GRASPED)/report/grasp_strip.png and $(GRASPED)/left/render/frame_*/tactile.png"
else
grasp:
	@echo "grasp: say which object: make -f Makefile.data grasp OBJECT=path.stl" >&2; exit 2
endif
