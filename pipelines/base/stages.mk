# How each stage makes its record from those before it.

# $(call run,stage,flags): a stage writes its record $@ into the folder of $@. OpenBLAS would start a thread per core as it is
# loaded, whatever --threads says; no stage wants them.
run = $(if $(always),{ )$(run_now)$(if $(silent),, && $(call finished,$(1)))$(if $(always),; } || (code=$$?; [ $$code = 3 ] || exit $$code))
run_now = OPENBLAS_NUM_THREADS=1 $(BIN)/$(1) --out $(@D) --threads $(THREADS) $(if $(always),--if-changed )$(if $(messages),,--log-level warning )$(2)
# Goals that make a few results have every stage look at the content of its inputs, whatever their dates: one whose record is of these very inputs
# and options does nothing (code 3). With any other goal dates tell (datasets compare hashes of their own), and they tell of pages, whose records are new if
# anything in them is.
looking := sample track gallery grasp scene robot robot-demo demo demo-full mpm-sample paper%
always  := $(if $(filter-out $(looking) build packages,$(or $(MAKECMDGOALS),help)),,FORCE)
finished = { [ ! -e $(@D)/$(1).yaml ] || awk -f pipelines/base/finished.awk $(@D)/$(1).timings.yaml $(@D)/$(1).yaml; }
# Messages of a running stage are shown by goals that make one sample; other goals run several stages at a time. Its log has them all.
messages = $(shown)$(silent)$(filter sample grasp scene robot mpm-sample track gallery,$(MAKECMDGOALS))
# $(call try,stage,flags): the same, but work that fails does not stop make: the page above it shows the reason in <stage>.failed.yaml.
try = $(call run,$(1),$(2)) || { [ $$? != 2 ] && echo "$@: not made" >&2; }
# $(call holds,record): fails unless the record's summary says so.
holds = @[ "$$($(BIN)/tacipc get $(1) summary.holds --default false)" = true ] || { echo "$(1): does not hold or is missing" >&2; exit 1; }

# Said before stages are run that are built only where their packages are.
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

# Embossed objects: $(OUT)/emboss/<pattern>/object.ply, then decimated in $(OUT)/objects/<pattern>
# (a picture that a pattern names lies beside its YAML)
$(OUT)/emboss/%/emboss.yaml: configs/objects/patterns/%.yaml $(wildcard configs/objects/patterns/*.png) $(always) | build
	$(call run,emboss,--config $<)

$(OUT)/objects/%/decimate.yaml: $(OUT)/emboss/%/emboss.yaml configs/objects/embossed.yaml configs/objects/decimate/default.yaml $(always) | build
	$(call run,decimate,--mesh $(OUT)/emboss/$*/object.ply --object configs/objects/embossed.yaml --config configs/objects/decimate/default.yaml)

REFERENCES := $(wildcard configs/sensors/*.png)# photographs that sensors name

# One sample: $(call sample_rules,folder,key=value …) with the keys name, object (a folder), object_yaml, sensor, mesh, motion (a file) and press
# (a file); `after` for every further prerequisite; by=try if its failure does not stop make.
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

# What of a dataset there is, failures and their reasons included: the page that make cannot make while a sample fails.
.PHONY: page
page: | build ## own: Page over the samples of OUT/DATASET, failed ones too: DATASET=demo (after make -k)
	$(if $(DATASET),,$(error page: say which, for instance DATASET=demo))
	$(BIN)/report --out $(OUT)/$(DATASET)/report --title "$(DATASET)" $(addprefix --sample ,$(patsubst %/press/,%,$(wildcard $(OUT)/$(DATASET)/*/press/)))
	$(call look,$(OUT)/$(DATASET))

# Where to look, said when a goal is done.
look = @echo; echo "Look at $(1)/report/index.html and $(1)/report/contact_sheet.png"
