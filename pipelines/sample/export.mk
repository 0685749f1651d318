# Exports VTK files of one sample, grasp, scene or robot for ParaView, and a glTF file: make -f Makefile.data export
# SAMPLE=out/demo/star
# A video of it: make -f Makefile.data export SAMPLE=out/demo/star FORMAT=video
$(call uses,sample/sample)

# FORMAT=video is taken from the command line; otherwise VTK and glTF (the variable belongs to `repack`, whose file has
# another default)
export_format := $(or $(patsubst FORMAT=%,%,$(filter FORMAT=%,$(MAKEOVERRIDES))),vtk)
SLOWER ?= auto#  video: slowdown relative to the motion (auto: single frames are visible)
slower_given := $(filter command,$(firstword $(origin SLOWER)))
override SLOWER := $(strip $(SLOWER))

.PHONY: export video_built
packages_for_export := $(filter video,$(export_format))
ifneq ($(strip $(SAMPLE)),)
ifneq ($(filter export,$(MAKECMDGOALS)),)
ifeq ($(filter vtk video,$(export_format)),)
  $(error FORMAT: '$(export_format)' is neither vtk nor video)
endif
$(call check_name,SLOWER)
ifneq ($(and $(filter vtk,$(export_format)),$(slower_given)),)
  $(error SLOWER: has no effect without FORMAT=video)
endif
endif
override SAMPLE := $(patsubst %/,%,$(strip $(SAMPLE)))
$(call check_name,SAMPLE)

# Folder of the press: for a grasp or a scene the folder itself.
exported := $(SAMPLE)$(if $(wildcard $(SAMPLE)/press.yaml),,/press)
# $(call press_input,gel): input file of the press; its record has the path relative to its own folder.
press_input = $(exported)/$$($(BIN)/tacipc get $(exported)/press.yaml inputs.$(1).path)

$(SAMPLE)/export/export.yaml: $(exported)/press.yaml $(always) | build
	$(call run,export,--press $(exported) --gel $(call press_input,gel) $$($(BIN)/tacipc get $(exported)/press.yaml inputs.object.path --default '' \
	  | sed -n 's#^.#--object $(exported)/&#p'))

# Gels of a video and their images: from the page if it has all frames, otherwise rendered in frames/.
filmed := $(or $(patsubst %/press/press.yaml,%,$(wildcard $(SAMPLE)/left/press/press.yaml $(SAMPLE)/right/press/press.yaml \
  $(SAMPLE)/gels/*/press/press.yaml)),$(SAMPLE))
has_all_frames = $(shell grep -ls '^ *frames: all$$' $(1)/render/render.yaml)
film_images := $(foreach g,$(filmed),$(g)/$(if $(call has_all_frames,$(g)),render,frames))
video_built: | build
	$(video_is_built)
define film_rule
$(1)/frames/render.yaml: $(1)/press/press.yaml configs/render/all_frames.yaml $$(REFERENCES) | build video_built
	$$(call run,render,--press $(1)/press --gel $(1)/press/$$$$($$(BIN)/tacipc get $(1)/press/press.yaml inputs.gel.path) \
	  --sensor $(1)/press/$$$$($$(BIN)/tacipc get $(1)/press/press.yaml inputs.sensor.path) --config configs/render/all_frames.yaml)
endef
ifeq ($(export_format)$(if $(OBJECT),object),video)
$(foreach g,$(patsubst %/frames,%,$(filter %/frames,$(film_images))),$(eval $(call film_rule,$(g))))
endif
$(SAMPLE)/video/choice.txt: FORCE
	$(call replace_if_changed,{slower: $(SLOWER)$(comma) images: $(film_images)})
$(SAMPLE)/video/video.yaml: $(exported)/press.yaml $(film_images:=/render.yaml) $(SAMPLE)/video/choice.txt | build video_built
	$(call run,video,--press $(exported) $(addprefix --render ,$(film_images)) --slower $(SLOWER))
	$(if $(wildcard $(SAMPLE)/report/report.yaml),$(film_page))
# The sample's own page is made again, because it shows the frames once they are rendered.
film_page = $(if $(filter $(SAMPLE)/frames,$(film_images)),OPENBLAS_NUM_THREADS=1 $(BIN)/report --out $(SAMPLE)/report --log-level warning \
  --title "$(notdir $(SAMPLE))" --sample $(SAMPLE))
film_says = $(if $(filter %/frames,$(film_images)),echo "All frames were rendered in $(filter %/frames,$(film_images)): \
  configs/render/all_frames.yaml with the noise of seed 1";) echo; \
  echo "Look at $(SAMPLE)/video/video.mp4"; $(BIN)/tacipc get $(SAMPLE)/video/video.yaml summary

export: $(SAMPLE)/$(if $(filter video,$(export_format)),video/video,export/export).yaml
export: ## own: One sample, grasp or scene for ParaView (VTK) and Blender (glTF), or FORMAT=video: SAMPLE=out/demo/star, SAMPLE=out/grasp/part
	@$(if $(filter video,$(export_format)),$(film_says),echo; \
	  echo "Open $(SAMPLE)/export/surface.pvd, volume.pvd and object.pvd in ParaView, sample.glb in Blender")
else
export:
	@echo "export: say which sample: make -f Makefile.data export SAMPLE=out/demo/star" >&2; exit 2
endif
