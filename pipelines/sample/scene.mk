# A scene of gels, soft, rigid and fixed bodies (docs/scenes.md): make -f Makefile.data scene
# SCENE=configs/scenes/lift_block.yaml
# SENSOR, MESH, PRESS, FRICTION and NAME have the same meaning as for `sample`.
$(call uses,sample/sample)

SCENE ?=#                  a file with the section `bodies`
SOFT  ?= uniform_0500um#   a file of configs/gels: tetrahedra of soft bodies that are given as a surface
$(foreach v,SCENE SOFT,$(eval override $(v) := $(strip $($(v)))))

.PHONY: scene
programs_for_scene := tetmesh press render report tacipc
ifneq ($(and $(filter scene,$(MAKECMDGOALS)),$(SCENE)),)
scene_name := $(or $(NAME),$(basename $(notdir $(SCENE))))
$(call check_name,SCENE)
$(call check_inside,scene_name)
ifeq ($(wildcard $(SCENE)),)
  $(error SCENE: $(SCENE) does not exist)
endif
$(call check_choices,SENSOR:sensors MESH:gels PRESS:press SOFT:gels)
useless := $(filter-out SENSOR MESH PRESS FRICTION NAME,$(given)) $(if $(OBJECT),OBJECT)
ifneq ($(strip $(useless)),)
  $(error $(firstword $(useless)): has no effect on a scene, whose file says it)
endif
SCENED       := $(OUT)/scene/$(scene_name)
scene_config := $(if $(FRICTION),$(SCENED)/press_config.yaml,configs/press/$(PRESS).yaml)
scene_gel    := $(OUT)/gels/$(SENSOR)-$(MESH)
# Bodies of the scene and their files; errors in them are reported before anything is made.
$(SCENED)/bodies.mk: $(SCENE) FORCE | build
	$(call replace_if_changed_by,bash pipelines/sample/scene_bodies.sh $(BIN)/tacipc $(SCENE))
include $(SCENED)/bodies.mk
$(SCENED)/choice.txt: FORCE
	$(call replace_if_changed,{scene: $(abspath $(SCENE))$(comma) sensor: $(SENSOR)$(comma) mesh: $(MESH)$(comma) press: $(PRESS)$(comma) soft: $(SOFT)})
$(SCENED)/press_config.yaml: configs/press/$(PRESS).yaml FORCE | build
	$(call replace_if_changed_by,$(BIN)/tacipc set $< 'friction.coefficient=$(FRICTION)')
define scene_soft_rule
$(SCENED)/tets/$(1)/tetmesh.yaml: $(scene_surface_$(1)) configs/gels/$(SOFT).yaml $(SCENED)/choice.txt $(always) | build
	$$(call run,tetmesh,--object $(scene_surface_$(1)) --config configs/gels/$(SOFT).yaml)
endef
$(foreach b,$(scene_soft),$(eval $(call scene_soft_rule,$(b))))
$(SCENED)/press.yaml: $(SCENE) $(scene_files) $(foreach b,$(scene_soft),$(SCENED)/tets/$(b)/tetmesh.yaml) $(scene_gel)/tetmesh.yaml \
    configs/sensors/$(SENSOR).yaml $(scene_config) $(SCENED)/choice.txt $(always) | build
	$(call run,press,--name $(scene_name) --gel $(scene_gel)/gel.msh --sensor configs/sensors/$(SENSOR).yaml --config $(scene_config) \
	  --sample $(SCENE) $(if $(scene_soft),--soft $(SCENED)/tets))
$(SCENED)/gels/%/render/render.yaml: $(SCENED)/press.yaml configs/sensors/$(SENSOR).yaml configs/render/all_frames.yaml $(REFERENCES) $(always) | build
	$(call run,render,--press $(SCENED)/gels/$*/press --gel $(scene_gel)/gel.msh --sensor configs/sensors/$(SENSOR).yaml --config configs/render/all_frames.yaml)
$(SCENED)/report/report.yaml: $(foreach g,$(scene_gels),$(SCENED)/gels/$(g)/render/render.yaml) | build
	$(call run,report,--title "$(scene_name)" --scene $(SCENED))

scene: ## own: Gels, soft, rigid and fixed bodies that touch: SCENE=configs/scenes/lift_block.yaml [SENSOR= MESH= PRESS= FRICTION= SOFT=uniform_0500um]
scene: $(SCENED)/report/report.yaml
	@echo; echo "Look at $(SCENED)/report/index.html, $(SCENED)/report/scene_strip.png and $(SCENED)/gels/*/render/frame_*/tactile.png"
else
scene:
	@echo "scene: say which scene: make -f Makefile.data scene SCENE=configs/scenes/lift_block.yaml" >&2; exit 2
endif
