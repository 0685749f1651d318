# VTK files of one sample, grasp or scene for ParaView, and a glTF file: make -f Makefile.data export SAMPLE=out/demo/star
$(call uses,sample/sample)

.PHONY: export
ifneq ($(strip $(SAMPLE)),)
override SAMPLE := $(patsubst %/,%,$(strip $(SAMPLE)))
$(call check_name,SAMPLE)

# A grasp's or a scene's own folder is what its press wrote.
exported := $(SAMPLE)$(if $(wildcard $(SAMPLE)/press.yaml),,/press)
# $(call press_input,gel): the file the press was made with; its record says where, as seen from its own folder.
press_input = $(exported)/$$($(BIN)/tacipc get $(exported)/press.yaml inputs.$(1).path)

$(SAMPLE)/export/export.yaml: $(exported)/press.yaml $(always) | build
	$(call run,export,--press $(exported) --gel $(call press_input,gel) $$($(BIN)/tacipc get $(exported)/press.yaml inputs.object.path --default '' \
	  | sed -n 's#^.#--object $(exported)/&#p'))

export: $(SAMPLE)/export/export.yaml ## own: One sample, grasp or scene for ParaView (VTK) and Blender (glTF): SAMPLE=out/demo/star, SAMPLE=out/grasp/part
	@echo; echo "Open $(SAMPLE)/export/surface.pvd, volume.pvd and object.pvd in ParaView, sample.glb in Blender"
else
export:
	@echo "export: say which sample: make -f Makefile.data export SAMPLE=out/demo/star" >&2; exit 2
endif
