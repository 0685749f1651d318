# One object of the user's own: make -f Makefile.data sample OBJECT=path.stl [SENSOR= MESH= DEPTH_MM= STEPS= UNIT= UP= FACE= ROTATE= CENTER=]

SENSOR   ?= mctac#            a file of configs/sensors
MESH     ?= adaptive_0250um#  a file of configs/tetmesh
DEPTH_MM ?= 0.5#              how deep the lowest point goes
STEPS    ?= 5#                frames on the way
UNIT     ?= mm#               of the object's file: m, cm, mm, um, in
UP       ?=#                  side of the object that looks away from the gel: +x -x +y -y +z -z
FACE     ?=#                  side that presses (default: opposite of UP, else -z)
ROTATE   ?= 0#                degrees about the sensor's z axis
CENTER   ?= 0,0#              where on the gel (mm) the centre of the object's bounding box lands
NAME     ?= $(basename $(notdir $(OBJECT)))# of the sample
$(foreach v,SENSOR MESH DEPTH_MM STEPS UNIT UP FACE ROTATE CENTER NAME,$(eval override $(v) := $(strip $($(v)))))

.PHONY: sample FORCE
ifdef OBJECT
$(call check_name,OBJECT)
$(call check_name,NAME)
ifeq ($(wildcard $(OBJECT)),)
  $(error OBJECT: $(OBJECT) does not exist)
endif
ifeq ($(wildcard configs/sensors/$(SENSOR).yaml),)
  $(error SENSOR: there is no configs/sensors/$(SENSOR).yaml (there are: $(SENSORS)))
endif
ifeq ($(wildcard configs/tetmesh/$(MESH).yaml),)
  $(error MESH: there is no configs/tetmesh/$(MESH).yaml (there are: $(MESHES)))
endif
SAMPLE := $(OUT)/sample/$(NAME)

# The variables as configuration files, rewritten only when they change.
define sample_yaml
placement:
  rotate_deg: $(ROTATE)
  center_mm: [$(CENTER)]
$(if $(FACE),  face: "$(FACE)")
motion: {kind: press, depth_mm: $(DEPTH_MM), steps: $(STEPS)}
endef
define object_yaml
unit: $(UNIT)
$(if $(UP),up: "$(UP)")
endef
# Which files are meant: another object, sensor or mesh under the same name must redo the sample however old its files are.
choice_yaml = {object: $(abspath $(OBJECT)), sensor: $(SENSOR), mesh: $(MESH)}
replace_if_changed = @mkdir -p $(@D); printf '%s\n' '$(subst $(newline),' ',$(1))' > $@.new; cmp -s $@.new $@ && rm $@.new || mv $@.new $@
define newline


endef
$(SAMPLE)/sample.yaml: FORCE
	$(call replace_if_changed,$(sample_yaml))
$(SAMPLE)/object.yaml: FORCE
	$(call replace_if_changed,$(object_yaml))
$(SAMPLE)/choice.txt: FORCE
	$(call replace_if_changed,$(choice_yaml))
$(SAMPLE)/object/decimate.yaml: $(OBJECT) $(SAMPLE)/object.yaml $(SAMPLE)/choice.txt configs/decimate/default.yaml | build
	$(call run,decimate,--mesh $(OBJECT) --object $(SAMPLE)/object.yaml --config configs/decimate/default.yaml)
$(eval $(call sample_rules,$(SAMPLE),$(NAME),$(SAMPLE)/object,$(SAMPLE)/object.yaml,$(SENSOR),$(MESH),$(SAMPLE)/sample.yaml,$(SAMPLE)/choice.txt))
$(eval $(call report_rules,$(SAMPLE),$(NAME),$(SAMPLE)))

sample: $(SAMPLE)/report/report.yaml ## One object of your own: OBJECT=path.stl [SENSOR MESH DEPTH_MM STEPS UNIT UP FACE ROTATE CENTER NAME]
	$(call look,$(SAMPLE))
else
sample:
	@echo "sample: say which object: make -f Makefile.data sample OBJECT=path.stl" >&2; exit 2
endif
