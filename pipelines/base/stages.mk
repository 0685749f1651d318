# Rules that make the record of each stage from the records of previous stages.

# $(call run,stage,flags): runs a stage, which writes its record $@ into the folder of $@. OpenBLAS would start a thread
# per core when it is loaded, regardless of --threads; no stage needs them.
run = $(if $(always),{ )$(run_now)$(if $(silent),, && $(call finished,$(1)))$(if $(always),; } || (code=$$?; [ $$code = 3 ] || exit $$code))
run_now = OPENBLAS_NUM_THREADS=1 $(BIN)/$(1) --out $(@D) --threads $(THREADS) $(if $(always),--if-changed )$(if $(messages),,--log-level warning )$(2)
# Targets that make few results let every stage compare the content of its inputs, regardless of their dates: a stage
# whose record has the same inputs and options does nothing (code 3). With other targets dates decide (datasets compare
# hashes of their own). Dates also decide for pages, whose records are new if any part is.
looking := sample track gallery grasp scene robot robot-demo demo demo-full mpm-sample paper%
always  := $(if $(filter-out $(looking) build packages,$(or $(MAKECMDGOALS),help)),,FORCE)
finished = { [ ! -e $(@D)/$(1).yaml ] || awk -f pipelines/base/finished.awk $(@D)/$(1).timings.yaml $(@D)/$(1).yaml; }
# Targets that make one sample show the messages of a running stage; other targets run several stages at a time. The log
# contains all messages.
messages = $(shown)$(silent)$(filter sample grasp scene robot mpm-sample track gallery,$(MAKECMDGOALS))
# $(call try,stage,flags): like `run`, but a failure does not stop make: the page above shows the reason in
# <stage>.failed.yaml.
try = $(call run,$(1),$(2)) || { [ $$? != 2 ] && echo "$@: not made" >&2; }
# $(call holds,record): fails unless `holds` is true in the record's summary.
holds = @[ "$$($(BIN)/tacipc get $(1) summary.holds --default false)" = true ] || { echo "$(1): does not hold or is missing" >&2; exit 1; }

# Message before stages run that are only built if their packages are installed.
depthnet_is_built = @[ -x $(BIN)/depthnet ] && [ -x $(BIN)/predict ] || \
  { echo "depthnet, predict: not built for want of packages: make -f Makefile.data packages build GROUPS='depthnet predict'" >&2; exit 2; }
wrap_is_built = @[ -x $(BIN)/wrap ] || { echo "wrap: not built for want of libcgal-dev: make -f Makefile.data packages build GROUPS=wrap" >&2; exit 2; }
video_is_built = @[ -x $(BIN)/video ] || { echo "video: not built for want of libavformat-dev: make -f Makefile.data packages build GROUPS=video" >&2; exit 2; }

SENSORS := $(basename $(notdir $(wildcard configs/sensors/*.yaml)))
MESHES  := $(basename $(notdir $(wildcard configs/gels/*.yaml)))

# Gels: one per sensor and mesh, $(OUT)/gels/<sensor>-<mesh>/gel.msh
define gel_rule
$$(OUT)/gels/$(1)-$(2)/tetmesh.yaml: configs/sensors/$(1).yaml configs/gels/$(2).yaml $(always) | build
	$$(call run,tetmesh,--sensor configs/sensors/$(1).yaml --config configs/gels/$(2).yaml)
endef
$(foreach s,$(SENSORS),$(foreach m,$(filter-out import_%,$(MESHES)),$(eval $(call gel_rule,$(s),$(m)))))

# Embossed objects: $(OUT)/emboss/<pattern>/object.ply, then decimated in $(OUT)/objects/<pattern>. A picture that a
# pattern names lies next to its YAML.
$(OUT)/emboss/%/emboss.yaml: configs/objects/patterns/%.yaml $(wildcard configs/objects/patterns/*.png) $(always) | build
	$(call run,emboss,--config $<)

$(OUT)/objects/%/decimate.yaml: $(OUT)/emboss/%/emboss.yaml configs/objects/embossed.yaml configs/objects/decimate/default.yaml $(always) | build
	$(call run,decimate,--mesh $(OUT)/emboss/$*/object.ply --object configs/objects/embossed.yaml --config configs/objects/decimate/default.yaml)

REFERENCES := $(wildcard configs/sensors/*.png)# photographs that sensors name

# One sample: $(call sample_rules,folder,key=value …) with the keys name, object (a folder), object_yaml, sensor, mesh,
# motion (a file) and press (a file); `after` for every further prerequisite; by=try if a failure must not stop make.
define sample_rules
$(call fields,sample,name object object_yaml sensor mesh motion press after by,$(2))
$(1)/press/press.yaml: $(sample_object)/decimate.yaml $(sample_object_yaml) $$(OUT)/gels/$(sample_sensor)-$(sample_mesh)/tetmesh.yaml \
    configs/sensors/$(sample_sensor).yaml $(sample_press) $(sample_motion) $(sample_after) $(always) | build
	$$(call $(or $(sample_by),run),press,--name $(sample_name) --object $(sample_object)/object.ply --object-config $(sample_object_yaml) \
	  --gel $$(OUT)/gels/$(sample_sensor)-$(sample_mesh)/gel.msh --sensor configs/sensors/$(sample_sensor).yaml --config $(sample_press) --sample $(sample_motion))
$(1)/render/render.yaml: $(1)/press/press.yaml configs/sensors/$(sample_sensor).yaml configs/render/default.yaml $$(REFERENCES) $(always) | build
	$$(call run,render,--press $(1)/press --gel $$(OUT)/gels/$(sample_sensor)-$(sample_mesh)/gel.msh \
	  --sensor configs/sensors/$(sample_sensor).yaml --config configs/render/default.yaml)
endef

# A page over samples: $(call report_rules,folder,title,sample folders)
define report_rules
$(1)/report/report.yaml: $(addsuffix /render/render.yaml,$(3)) | build
	$$(call run,report,--title "$(2)" $(addprefix --sample ,$(3)))
endef

# Page over the existing part of a dataset, including failures and their reasons, which make cannot build while a sample
# fails.
.PHONY: page
page: | build ## own: Page over the samples of OUT/DATASET, failed ones too: DATASET=demo (after make -k)
	$(if $(DATASET),,$(error page: say which, for instance DATASET=demo))
	$(BIN)/report --out $(OUT)/$(DATASET)/report --title "$(DATASET)" $(addprefix --sample ,$(patsubst %/press/,%,$(wildcard $(OUT)/$(DATASET)/*/press/)))
	$(call look,$(OUT)/$(DATASET))

# Final message of a target: where to look.
look = @echo; echo "Look at $(1)/report/index.html and $(1)/report/contact_sheet.png"
