# The friction experiments of the paper: board3 is pressed 0.5 mm into a 3 mm gel, then moved by 1 mm or turned by 0.25
# rad; the result is the smoothness of the markers' motion. MESH= selects another file of configs/gels: import_paper_3mm
# is the published gel (long). PRESS= selects another file of configs/press: with friction_every every pair counts, as
# in the reference code; friction has no viscosity.
# SHARED is a folder with data/tacipc_release (not part of this repository). ALSO= names folders of the same motions by
# other simulators, which the plots also show (markers.csv, markers.npy, marker_displacement.npy, object_pose.npy,
# phase.npy).
$(call uses,sample/sample sample/objects verification/verification)

ALSO ?=#  runs of other simulators
override ALSO := $(strip $(ALSO))

BOARD3 := $(OUT)/board3
BOARD3_MESH := $(if $(filter MESH,$(given)),$(MESH),focused_0200um)
BOARD3_PRESS := $(if $(filter PRESS,$(given)),$(PRESS),friction_viscous)
BOARD3_RUN := $(BOARD3)/$(BOARD3_MESH)-$(BOARD3_PRESS)
BOARD3_SAMPLES := board3_shear board3_twist
BOARD3_RECORD := $(BOARD3_RUN)/page/marker_curve.yaml
BOARD3_OBJECT := $(SHARED)/data/tacipc_release/objects/board3.obj

ifneq ($(filter board3,$(LONG_ROWS)),)
ifeq ($(wildcard $(BOARD3_OBJECT)),)
  $(error SHARED: there is no $(BOARD3_OBJECT))
endif
ifeq ($(wildcard configs/gels/$(BOARD3_MESH).yaml),)
  $(error MESH: there is no configs/gels/$(BOARD3_MESH).yaml (there are: $(MESHES)))
endif
ifeq ($(wildcard configs/press/$(BOARD3_PRESS).yaml),)
  $(error PRESS: there is no configs/press/$(BOARD3_PRESS).yaml)
endif
endif

$(BOARD3)/object/decimate.yaml: $(BOARD3_OBJECT) configs/objects/printed_indenter.yaml configs/objects/decimate/default.yaml $(always) | build
	$(call run,decimate,--mesh $(BOARD3_OBJECT) --object configs/objects/printed_indenter.yaml --config configs/objects/decimate/default.yaml)

# The published gel with its third axis scaled.
$(OUT)/gels/mctac_3mm-import_paper_3mm/tetmesh.yaml: $(PAPER_GEL) configs/gels/import_paper_3mm.yaml configs/sensors/mctac_3mm.yaml $(always) | build
	$(call run,tetmesh,--import $(PAPER_GEL) --sensor configs/sensors/mctac_3mm.yaml --config configs/gels/import_paper_3mm.yaml)

# $(call board3_rules,folder,name,mesh,motion below configs/studies/board3,press)
board3_rules = $(call sample_rules,$(1),name=$(2) object=$(BOARD3)/object object_yaml=configs/objects/printed_indenter.yaml sensor=mctac_3mm \
  mesh=$(3) motion=configs/studies/board3/$(4).yaml press=$(5) by=try)
$(foreach s,$(BOARD3_SAMPLES),$(eval $(call board3_rules,$(BOARD3_RUN)/$(s),$(s),$(BOARD3_MESH),$(s),configs/press/$(BOARD3_PRESS).yaml)))

$(BOARD3_RECORD): configs/studies/board3/marker_curve.yaml $(BOARD3_SAMPLES:%=$(BOARD3_RUN)/%/press/press.yaml) \
    $(if $(filter board3,$(MAKECMDGOALS)),$(wildcard $(ALSO:%=%/*.npy))) $(always) | build-verification
	$(call try,marker_curve,--config $< $(BOARD3_SAMPLES:%=--press $(BOARD3_RUN)/%/press) $(if $(filter board3,$(MAKECMDGOALS)),$(ALSO:%=--other %)))

.PHONY: board3 board3-page
board3-page: $(BOARD3_RECORD)
	$(call copy_tables,board3,$(BOARD3_RECORD))

board3: board3-page ## studies: Friction experiments of the paper (needs SHARED); writes OUT/docs/verification/board3.md with its plots (an hour)
	$(call holds,$(BOARD3_RECORD))
