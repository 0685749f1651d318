# Marker vectors measured in photographs against simulated ones: make -f Makefile.data fots [MARKERS=configs/benchmarks/fots_markers.yaml]
# The file says which vectors (below SHARED), what is simulated and what is held; docs/fots.md has the table. ALSO= folders of the
# same presses by another simulator (markers.npy, marker_displacement.npy, object_pose.npy, phase.npy in any folder below) add rows
# (ALSO is declared in board3.mk).

MARKERS ?= configs/benchmarks/fots_markers.yaml#  the benchmark
override MARKERS := $(strip $(MARKERS))
FOTS := $(OUT)/fots/$(basename $(notdir $(MARKERS)))

.PHONY: fots fots-page
ifneq ($(filter fots fots-page,$(MAKECMDGOALS)),)
$(call check_name,MARKERS)
$(call check_name,SHARED)
ifeq ($(wildcard $(MARKERS)),)
  $(error MARKERS: $(MARKERS) does not exist)
endif
ifeq ($(wildcard $(SHARED)),)
  $(error SHARED: $(SHARED) does not exist; the measured vectors are looked for there)
endif

# What the stages are told: made from the one file first, then make starts anew with its variables.
$(FOTS)/cases/cases.yaml: $(MARKERS) | build
	$(call run,cases,--config $<)
$(FOTS)/cases/cases.mk: $(FOTS)/cases/cases.yaml ;
include $(FOTS)/cases/cases.mk

# The ball, the gel and the press configuration of the base and of each variant, then a press to each depth.
define fots_variant
$(FOTS)/runs/$(1)/indenter/indenter.yaml: $(FOTS)/cases/cases.yaml | build
	$$(call run,indenter,--config $(FOTS)/cases/$(1)/indenter.yaml)
$(FOTS)/runs/$(1)/settings/sensor.yaml: $(MARKERS_SENSOR) $(FOTS)/cases/cases.yaml
	mkdir -p $$(@D)
	sed '$(if $(MARKERS_THICKNESS_MM_$(1)),s/^  thickness_mm: [0-9.]*/  thickness_mm: $(MARKERS_THICKNESS_MM_$(1))/)' $(MARKERS_SENSOR) > $$@
$(FOTS)/runs/$(1)/settings/press.yaml: $(MARKERS_PRESS) $(FOTS)/cases/cases.yaml
	mkdir -p $$(@D)
	cat $(MARKERS_PRESS) $(FOTS)/cases/$(1)/friction.yaml > $$@
$(FOTS)/runs/$(1)/gel/tetmesh.yaml: $(FOTS)/runs/$(1)/settings/sensor.yaml $(MARKERS_MESH) | build
	$$(call run,tetmesh,--sensor $(FOTS)/runs/$(1)/settings/sensor.yaml --config $(MARKERS_MESH))
endef
define fots_run
$(FOTS)/runs/$(1)/$(2)/press.yaml: $(FOTS)/runs/$(1)/indenter/indenter.yaml $(FOTS)/runs/$(1)/gel/tetmesh.yaml $(FOTS)/runs/$(1)/settings/press.yaml | build
	$$(call run,press,--name $(1)_$(2) --object $(FOTS)/runs/$(1)/indenter/object.ply --object-config configs/objects/embossed.yaml --gel $(FOTS)/runs/$(1)/gel/gel.msh \
	  --sensor $(FOTS)/runs/$(1)/settings/sensor.yaml --config $(FOTS)/runs/$(1)/settings/press.yaml --sample $(FOTS)/cases/motion_$(2).yaml)
endef
$(foreach v,$(MARKERS_VARIANTS),$(eval $(call fots_variant,$(v)))$(foreach d,$(MARKERS_DEPTHS),$(eval $(call fots_run,$(v),$(d)))))

$(FOTS)/fit/marker_fit.yaml: $(MARKERS) $(foreach v,$(MARKERS_VARIANTS),$(foreach d,$(MARKERS_DEPTHS),$(FOTS)/runs/$(v)/$(d)/press.yaml)) \
    $(addprefix $(SHARED)/,$(MARKERS_PRESSED) $(MARKERS_SHEARED)) $(foreach a,$(ALSO),$(shell find $(a) -name "*.npy")) | build
	$(call run,marker_fit,--config $(MARKERS) --pressed $(SHARED)/$(MARKERS_PRESSED) --sheared $(SHARED)/$(MARKERS_SHEARED) \
	  $(foreach v,$(MARKERS_VARIANTS),--runs $(FOTS)/runs/$(v)) $(addprefix --runs ,$(ALSO)))

# docs/ holds the table of the shipped benchmark; its prose stays, the lines between the marks are replaced.
fots_name := $(basename $(notdir $(MARKERS)))
fots-page: $(FOTS)/fit/marker_fit.yaml
	if grep -qs '^<!-- $(fots_name) -->' docs/fots.md; then \
	  sed -i -e '/^<!-- $(fots_name) -->/,/^<!-- end of table -->/{/^<!-- $(fots_name) -->/r $(FOTS)/fit/table.md' -e '/^<!--/!d}' docs/fots.md; \
	  for field in press shear; do cp $(FOTS)/fit/$$field.svg docs/$(fots_name)_$$field.svg; done; fi
	@cat $(FOTS)/fit/table.md
	@echo; echo "Look at $(FOTS)/fit/press.svg and shear.svg; the vectors are in vectors.csv"

fots: fots-page ## Simulated marker vectors against measured ones of a real sensor (needs SHARED; minutes); writes the table in docs/fots.md
endif
