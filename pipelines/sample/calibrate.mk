# Makes a sensor file from a user's own photographs:
# make -f Makefile.data calibrate-sensor SENSOR_FILE=my/sensor.yaml BACKGROUND=my/background.png [PHOTOGRAPHS=my/balls
# LABELS=my/labels.txt BALL_MM=3]
# docs/sensors.md explains the photographs, docs/calibrate.md the fit.
$(call uses,sample/sample)

SENSOR_FILE ?=#              the sensor file as far as it is known (start from a file of configs/sensors)
BACKGROUND  ?=#              photograph without contact, PNG of the camera's size
PHOTOGRAPHS ?=#              folder of photographs of a ball pressed into the gel
LABELS      ?=#              lines `image.png (x, y) radius` in pixels: its contacts
BALL_MM     ?= 3#            radius of that ball
GAP_MM      ?= 0.02#         gap between ball and gel at the labelled rim, mm
LABEL_PX    ?= 1#            standard deviation of a label's centre and radius, px
DEEPEST_MM  ?= 1#            depth of the simulated press, mm: no label may show more
BALL_PRESS  ?= configs/studies/sim2real/gsmini_balls/press.yaml# slow press with a small gap
FIT         ?=#              a configuration with sensor_fit (default: configs/sensors/calibrate/ring.yaml or list.yaml, by the LEDs' arrangement)
CALIBRATE_VARIABLES := SENSOR_FILE BACKGROUND PHOTOGRAPHS LABELS BALL_MM GAP_MM LABEL_PX DEEPEST_MM BALL_PRESS FIT
$(foreach v,$(CALIBRATE_VARIABLES),$(eval override $(v) := $(strip $($(v)))))

.PHONY: calibrate-sensor
ifdef SENSOR_FILE
$(foreach v,SENSOR_FILE BACKGROUND PHOTOGRAPHS LABELS BALL_PRESS FIT,$(call check_name,$(v)))
ifeq ($(BACKGROUND),)
  $(error BACKGROUND: say which photograph shows the gel without contact)
endif
ifneq ($(words $(PHOTOGRAPHS) $(LABELS)),$(if $(PHOTOGRAPHS)$(LABELS),2,0))
  $(error PHOTOGRAPHS, LABELS: give both or none)
endif
$(foreach v,SENSOR_FILE BACKGROUND PHOTOGRAPHS LABELS BALL_PRESS FIT,$(if $(wildcard $($(v))),,$(if $($(v)),$(error $(v): $($(v)) does not exist))))
ifeq ($(wildcard configs/gels/$(MESH).yaml),)
  $(error MESH: there is no configs/gels/$(MESH).yaml (there are: $(MESHES)))
endif
CALIBRATED := $(OUT)/calibrate/$(basename $(notdir $(SENSOR_FILE)))
calibrate_photographs := $(if $(PHOTOGRAPHS),$(wildcard $(PHOTOGRAPHS)/*.png))

# Default configuration by the arrangement of the sensor's LEDs; FIT selects another one.
calibrate_fit = $(or $(FIT),configs/sensors/calibrate/$$(if $(BIN)/tacipc get $(SENSOR_FILE) leds.ring > /dev/null 2>&1; \
  then echo ring; else echo list; fi).yaml)
calibrate_balls = {radius_mm: $(BALL_MM)$(comma) contact_gap_mm: $(GAP_MM)$(comma) label_sigma_px: $(LABEL_PX)}
define ball_motion_yaml
motion: {kind: press, depth_mm: $(DEEPEST_MM), steps: 20}
endef
$(CALIBRATED)/fit.yaml: $(SENSOR_FILE) $(FIT) FORCE | build
	$(call replace_if_changed_by,$(BIN)/tacipc set $(calibrate_fit) $(if $(LABELS),'+sensor_fit.balls=$(calibrate_balls)'))
$(CALIBRATED)/indenter.yaml: FORCE
	$(call replace_if_changed,ball: {radius_mm: $(BALL_MM)$(comma) edge_mm: 0.2})
$(CALIBRATED)/motion.yaml: FORCE
	$(call replace_if_changed,$(ball_motion_yaml))
$(CALIBRATED)/gel/tetmesh.yaml: $(SENSOR_FILE) configs/gels/$(MESH).yaml $(always) | build
	$(call run,tetmesh,--sensor $(SENSOR_FILE) --config configs/gels/$(MESH).yaml)
$(CALIBRATED)/indenter/indenter.yaml: $(CALIBRATED)/indenter.yaml $(always) | build
	$(call run,indenter,--config $<)
$(CALIBRATED)/press/press.yaml: $(CALIBRATED)/indenter/indenter.yaml $(CALIBRATED)/gel/tetmesh.yaml $(CALIBRATED)/motion.yaml $(SENSOR_FILE) \
    $(BALL_PRESS) $(always) | build
	$(call run,press,--name ball --object $(CALIBRATED)/indenter/object.ply --object-config configs/objects/embossed.yaml \
	  --gel $(CALIBRATED)/gel/gel.msh --sensor $(SENSOR_FILE) --config $(BALL_PRESS) --sample $(CALIBRATED)/motion.yaml)
$(CALIBRATED)/fit/calibrate.yaml: $(SENSOR_FILE) $(BACKGROUND) $(calibrate_photographs) $(LABELS) $(CALIBRATED)/fit.yaml \
    $(if $(LABELS),$(CALIBRATED)/press/press.yaml) $(always) | build
	$(call run,calibrate,--config $(CALIBRATED)/fit.yaml --sensor $(SENSOR_FILE) --background $(BACKGROUND) $(if $(LABELS), \
	  --photographs $(PHOTOGRAPHS) --labels $(LABELS) --press $(CALIBRATED)/press --gel $(CALIBRATED)/gel/gel.msh))

calibrate-sensor: ## own: A sensor file from your photographs: SENSOR_FILE=my.yaml BACKGROUND=no_contact.png [PHOTOGRAPHS= LABELS= BALL_MM=]
calibrate-sensor: $(CALIBRATED)/fit/calibrate.yaml
	@echo; $(BIN)/tacipc get $< summary.parameters --fields name$(comma)value$(comma)sigma$(comma)told_by | \
	  while IFS=$$'\t' read -r name value sigma told_by; do \
	  LC_ALL=C printf '%-24s %10.4g ± %-8.2g determined by the %s\n' "$$name" "$$value" "$$sigma" "$$told_by"; done
	@echo; echo "Look at $(CALIBRATED)/fit/residuals/*.png (128 grey: explained; eight times the residual). The sensor is $(CALIBRATED)/fit/sensor.yaml"
else
calibrate-sensor:
	@echo "calibrate-sensor: say which: make -f Makefile.data calibrate-sensor SENSOR_FILE=my.yaml BACKGROUND=no_contact.png" >&2; exit 2
endif
