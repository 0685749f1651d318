# VTK files of one sample, for ParaView: make -f Makefile.data export SAMPLE=out/demo/star

.PHONY: export
ifneq ($(strip $(SAMPLE)),)
override SAMPLE := $(patsubst %/,%,$(strip $(SAMPLE)))
$(call check_name,SAMPLE)

# $(call press_input,gel): the file the press was made with; its record says where, as seen from its own folder.
press_input = $(SAMPLE)/press/$$(awk '/^inputs:/ { inputs = 1 } inputs && $$1 == "$(1):" { here = 1 } here && $$1 == "path:" { print $$2; exit }' $(SAMPLE)/press/press.yaml)

$(SAMPLE)/export/export.yaml: $(SAMPLE)/press/press.yaml | build
	$(call run,export,--press $(SAMPLE)/press --gel $(call press_input,gel) --object $(call press_input,object))

export: $(SAMPLE)/export/export.yaml ## VTK files of one sample for ParaView: SAMPLE=out/demo/star
	@echo; echo "Open $(SAMPLE)/export/surface.pvd, volume.pvd and object.pvd in ParaView"
else
export:
	@echo "export: say which sample: make -f Makefile.data export SAMPLE=out/demo/star" >&2; exit 2
endif
