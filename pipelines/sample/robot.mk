# A robot of MuJoCo with gels on its fingers (docs/robot.md): make -f Makefile.data robot
# TASK=configs/tasks/lift_and_shake.yaml
# SENSOR, MESH, PRESS, SEED and NAME have the same meaning as for `sample` and `grasp`.
$(call uses,sample/sample sample/grasp)

TASK  ?=#      a task of configs/tasks, or a file of your own
ALONE ?= no#   yes: the robot moves by MuJoCo's own contacts, and the gels follow; no: the gels' response loads the robot
$(foreach v,TASK ALONE,$(eval override $(v) := $(strip $($(v)))))

ifeq ($(filter yes no,$(ALONE)),)
  $(error ALONE: yes or no)
endif
robot_is_built = @[ -x $(BIN)/robot ] || { echo "robot: not built for want of libmujoco-dev: make -f Makefile.data packages build GROUPS=robot" >&2; exit 2; }

# $(call robot_rules,folder,name,task,sensor,mesh,press,seed): the robot in folder/robot, the results of its gels in
# folder, the page in folder/report. Make does not track files that a task names: results depend on the contents of the
# task's own folders.
robot_pads = { $(BIN)/tacipc get $(1) pads --fields name 2> /dev/null || $(BIN)/tacipc get $(1) pads.name; }# lists the pads of a task
# Make would interpret other characters in a name.
plain_pads = { ! $(call robot_pads,$(1)) | grep -q '[^A-Za-z0-9_-]' || { echo "TASK: $(1): a pad's name has letters, digits, _ and - alone" >&2; exit 1; }; }
define robot_rules
$(1)/choice.txt: FORCE
	$$(call replace_if_changed,{task: $$(abspath $(3))$$(comma) sensor: $(4)$$(comma) mesh: $(5)$$(comma) press: $(6)$$(comma) seed: $(7)$$(comma) \
	  alone: $$(ALONE)})
$(1)/robot/robot.yaml: $(3) $$(wildcard $$(dir $(3))*.xml configs/robots/*.xml) $$(OUT)/gels/$(4)-$(5)/tetmesh.yaml configs/sensors/$(4).yaml \
    configs/press/$(6).yaml $(1)/choice.txt $(always) | build
	$$(robot_is_built)
	$(if $(filter yes,$(ALONE)),rm -f $(1)/residuals.csv; $$(call run,robot,--name $(2) --task $(3) --seed $(7)),\
	  OPENBLAS_NUM_THREADS=1 bash pipelines/sample/couple.sh $$(BIN) $(1) $(3) --name $(2) --task $(3) --seed $(7) -- \
	    --name $(2) --gel $$(OUT)/gels/$(4)-$(5)/gel.msh --sensor configs/sensors/$(4).yaml --config configs/press/$(6).yaml --threads $$(THREADS))
$(1)/press.yaml: $(1)/robot/robot.yaml $(always) | build
	$$(call run,press,--name $(2) --gel $$(OUT)/gels/$(4)-$(5)/gel.msh --sensor configs/sensors/$(4).yaml --config configs/press/$(6).yaml \
	  --sample $(1)/robot/scene.yaml $(if $(filter yes,$(ALONE)),,--solved $(1)/solved))
$(1)/gels/%/render/render.yaml: $(1)/press.yaml configs/sensors/$(4).yaml configs/render/all_frames.yaml $$(REFERENCES) $(always) | build
	$$(call run,render,--press $(1)/gels/$$*/press --gel $$(OUT)/gels/$(4)-$(5)/gel.msh --sensor configs/sensors/$(4).yaml --config configs/render/all_frames.yaml)
# Names of the gels.
$(1)/pads.mk: $(3) FORCE | build
	$$(call replace_if_changed_by,$$(call plain_pads,$(3)) && echo "robot_pads_$(2) := $$$$($$(call robot_pads,$(3)) | paste -s -d ' ')")
include $(1)/pads.mk
$(1)/report/report.yaml: $$(foreach p,$$(robot_pads_$(2)),$(1)/gels/$$(p)/render/render.yaml) | build
	$$(call run,report,--title "$(2)" --scene $(1))
endef

.PHONY: robot robot-demo
programs_for_robot := robot tetmesh press render report tacipc
packages_for_robot := robot
ifneq ($(and $(filter robot,$(MAKECMDGOALS)),$(TASK)),)
robot_name := $(or $(NAME),$(basename $(notdir $(TASK))))
$(call check_name,TASK)
$(call check_inside,robot_name)
ifeq ($(wildcard $(TASK)),)
  $(error TASK: $(TASK) does not exist)
endif
$(call check_choices,SENSOR:sensors MESH:gels PRESS:press)
useless := $(filter-out SENSOR MESH PRESS NAME,$(given)) $(if $(OBJECT),OBJECT)
ifneq ($(strip $(useless)),)
  $(error $(firstword $(useless)): has no effect on a robot, whose task says it)
endif
ROBOTED := $(OUT)/robot/$(robot_name)
$(eval $(call robot_rules,$(ROBOTED),$(robot_name),$(TASK),$(SENSOR),$(MESH),$(PRESS),$(SEED)))

robot: ## own: A robot of MuJoCo with gels on its fingers: TASK=configs/tasks/lift_and_shake.yaml [SEED=1 SENSOR= MESH= PRESS=; ALONE=yes: the gels only follow]
robot: $(ROBOTED)/report/report.yaml
	@echo; echo "Look at $(ROBOTED)/report/index.html and $(ROBOTED)/gels/*/render/frame_*/tactile.png"
else
robot:
	@echo "robot: say which task: make -f Makefile.data robot TASK=configs/tasks/lift_and_shake.yaml" >&2; exit 2
endif

# The four tasks that are shipped, on a coarser gel.
demo_tasks := lift_and_shake turn_in_hand insert_peg slide_over
demo_mesh  := adaptive_0400um
programs_for_robot-demo := $(programs_for_robot)
packages_for_robot-demo := robot
ifneq ($(filter robot-demo,$(MAKECMDGOALS)),)
$(foreach t,$(demo_tasks),$(eval $(call robot_rules,$(OUT)/robot-demo/$(t),$(t),configs/tasks/$(t).yaml,mctac,$(demo_mesh),default,1)))
demo_pages := $(foreach t,$(demo_tasks),$(OUT)/robot-demo/$(t)/report/report.yaml)
$(OUT)/robot-demo/report/report.yaml: $(demo_pages) | build
	$(call run,report,--title "Robots with gels on their fingers" $(foreach t,$(demo_tasks),--scene $(OUT)/robot-demo/$(t)))
robot-demo: $(OUT)/robot-demo/report/report.yaml ## start: Four tasks of robots with gels on their fingers, with pages
	@echo; echo "Look at $(OUT)/robot-demo/report/index.html"
endif
