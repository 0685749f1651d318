# The image table on embossed objects: all of configs/emboss pressed 0.5 mm into mctac by three simulators, each through the same optics and through
# the published ones, against a finer simulation with full light transport; and the ablation of gel meshes. Variables are in paper.mk.

COINS_SENSOR := configs/sensors/mctac.yaml
COINS_MOTION := configs/samples/press_0500um.yaml
COINS_LAST   := frame_0005# the end of that motion
coins_object = --object $(OUT)/objects/$(1)/object.ply --object-config configs/objects/embossed.yaml

# $(call coins_render,folder,press,mesh,configuration): another rendering of a press
define coins_render
$(1)/render.yaml: $(2)/press.yaml $(COINS_SENSOR) configs/render/$(4).yaml $$(REFERENCES) | build
	$$(call run,render,--press $(2) --gel $(OUT)/gels/mctac-$(3)/gel.msh --sensor $(COINS_SENSOR) --config configs/render/$(4).yaml)
endef

# $(call coins_rules,folder,object)
define coins_rules
$(call sample_rules,$(1)/tacipc,$(2),$(OUT)/objects/$(2),configs/objects/embossed.yaml,mctac,$(PAPER_OURS),$(COINS_MOTION),configs/press/default.yaml)
$(1)/fine/press/press.yaml: $(OUT)/objects/$(2)/decimate.yaml $(OUT)/gels/mctac-$(PAPER_FINE)/tetmesh.yaml $(COINS_SENSOR) $(COINS_MOTION) configs/press/default.yaml | build
	$$(call run,press,--name $(2) $(call coins_object,$(2)) --gel $(OUT)/gels/mctac-$(PAPER_FINE)/gel.msh --sensor $(COINS_SENSOR) --config configs/press/default.yaml --sample $(COINS_MOTION))
$(call coins_render,$(1)/fine/render,$(1)/fine/press,$(PAPER_FINE),$(PAPER_LIGHT))
$(call coins_render,$(1)/noise/render,$(1)/fine/press,$(PAPER_FINE),default)
$(1)/tacchi/mpm/mpm.yaml: $(OUT)/objects/$(2)/decimate.yaml $(COINS_SENSOR) $(COINS_MOTION) configs/mpm/legacy_mctac.yaml | build
	$$(call run,mpm,--name $(2) $(call coins_object,$(2)) --sensor $(COINS_SENSOR) --config configs/mpm/legacy_mctac.yaml --sample $(COINS_MOTION))
$(1)/tacchi/render/render.yaml: $(1)/tacchi/mpm/mpm.yaml $(COINS_SENSOR) configs/render/default.yaml | build
	$$(call run,render,--shapes $(1)/tacchi/mpm/$(COINS_LAST)/seen_indentation.exr --sensor $(COINS_SENSOR) --config configs/render/default.yaml)
$(1)/tacchi/legacy/baseline.yaml: $(1)/tacchi/mpm/mpm.yaml $(1)/tacipc/render/render.yaml configs/baseline/tacchi.yaml | build
	$$(call run,baseline,--config configs/baseline/tacchi.yaml --sensor $(COINS_SENSOR) --background $(1)/tacipc/render/frame_0000/tactile.png --depth $(1)/tacchi/mpm/$(COINS_LAST)/depth.exr)
$(1)/tacipc/legacy/baseline.yaml: $(1)/tacipc/render/render.yaml configs/baseline/tacchi.yaml | build
	$$(call run,baseline,--config configs/baseline/tacchi.yaml --sensor $(COINS_SENSOR) --background $(1)/tacipc/render/frame_0000/tactile.png --depth $(1)/tacipc/render/$(COINS_LAST)/depth.exr)
$(1)/depth-based/heights/baseline.yaml: $(1)/tacipc/press/press.yaml configs/baseline/height_map.yaml | build
	$$(call run,baseline,--config configs/baseline/height_map.yaml --sensor $(COINS_SENSOR) $(call coins_object,$(2)) --pose $(1)/tacipc/press/object_pose.npy)
$(1)/depth-based/render/render.yaml: $(1)/depth-based/heights/baseline.yaml configs/render/default.yaml | build
	$$(call run,render,--shapes $(1)/depth-based/heights/$(COINS_LAST)/indentation.exr --sensor $(COINS_SENSOR) --config configs/render/default.yaml)
$(1)/depth-based/legacy/baseline.yaml: $(1)/tacipc/render/render.yaml configs/baseline/gomes_2021.yaml | build
	$$(call run,baseline,--config configs/baseline/gomes_2021.yaml --sensor $(COINS_SENSOR) --background $(1)/tacipc/render/frame_0000/tactile.png $(call coins_object,$(2)) --pose $(1)/tacipc/press/object_pose.npy)
$(1)/older_kernel/legacy/baseline.yaml: $(1)/tacipc/render/render.yaml configs/baseline/exponential_13.yaml | build
	$$(call run,baseline,--config configs/baseline/exponential_13.yaml --sensor $(COINS_SENSOR) --background $(1)/tacipc/render/frame_0000/tactile.png $(call coins_object,$(2)) --pose $(1)/tacipc/press/object_pose.npy)
endef
$(foreach o,$(PAPER_OBJECTS),$(eval $(call coins_rules,$(PAPER)/objects/$(o),$(o))))

# What each method makes of each object under the object's name, so that all are compared alike: the folder of a method below that of its object, and its picture.
COINS_IMAGES := $(PAPER)/objects-table/images
COINS_FROM_fine                := fine/render $(COINS_LAST)/tactile.png
COINS_FROM_noise               := noise/render $(COINS_LAST)/tactile.png
COINS_FROM_rest                := noise/render frame_0000/tactile.png
COINS_FROM_tacipc              := tacipc/render $(COINS_LAST)/tactile.png
COINS_FROM_tacchi              := tacchi/render frame_0001/tactile.png
COINS_FROM_depth-based         := depth-based/render frame_0001/tactile.png
COINS_FROM_tacipc_legacy       := tacipc/legacy frame_0000/tactile.png
COINS_FROM_tacchi_legacy       := tacchi/legacy frame_0000/tactile.png
COINS_FROM_depth-based_legacy  := depth-based/legacy $(COINS_LAST)/tactile.png
COINS_FROM_older_kernel_legacy := older_kernel/legacy $(COINS_LAST)/tactile.png
COINS_METHODS := fine noise rest tacipc tacchi depth-based tacipc_legacy tacchi_legacy depth-based_legacy older_kernel_legacy
COINS_SHAPES  := fine tacipc tacchi depth-based# methods whose depth is compared

coins_record = $(firstword $(COINS_FROM_$(1)))/$(if $(filter render,$(notdir $(firstword $(COINS_FROM_$(1))))),render,baseline).yaml
define coins_images
$(COINS_IMAGES)/$(1)/collected: $(foreach o,$(PAPER_OBJECTS),$(PAPER)/objects/$(o)/$(call coins_record,$(1))) pipelines/paper_coins.mk
	rm -rf $$(@D)
	mkdir -p $$(@D)
	for o in $(PAPER_OBJECTS); do from=$(PAPER)/objects/$$$$o/$(firstword $(COINS_FROM_$(1))); cp $$$$from/$(lastword $(COINS_FROM_$(1))) $$(@D)/$$$$o.png; \
	  $(if $(filter $(1),$(COINS_SHAPES)),cp $$$$from/$(patsubst %tactile.png,%depth.exr,$(lastword $(COINS_FROM_$(1)))) $$(@D)/$$$$o.exr;) done
	touch $$@
$(PAPER)/objects-table/metrics/$(1)/metrics.yaml: $(COINS_IMAGES)/$(1)/collected $(COINS_IMAGES)/fine/collected configs/metrics/paper_objects.yaml | build
	$$(call run,metrics,--config configs/metrics/paper_objects.yaml --images $(COINS_IMAGES)/$(1) --reference $(COINS_IMAGES)/fine)
$(PAPER)/objects-table/depth/$(1)/depth_metrics.yaml: $(COINS_IMAGES)/$(1)/collected $(COINS_IMAGES)/fine/collected configs/depth_metrics/default.yaml | build
	$$(call run,depth_metrics,--config configs/depth_metrics/default.yaml --images $(PAPER_OBJECTS:%=$(COINS_IMAGES)/$(1)/%.exr) \
	  --reference $(PAPER_OBJECTS:%=$(COINS_IMAGES)/fine/%.exr) --rest $(PAPER)/objects/$(firstword $(PAPER_OBJECTS))/fine/render/frame_0000/depth.exr)
endef
$(foreach m,$(COINS_METHODS),$(eval $(call coins_images,$(m))))

COINS_RIVALS := $(filter-out fine,$(COINS_METHODS))
$(PAPER)/objects-table/image_table.yaml: configs/image_table/$(PAPER_TABLES)_objects.yaml $(COINS_RIVALS:%=$(PAPER)/objects-table/metrics/%/metrics.yaml) | build
	$(call run,image_table,--config $< --samples $(COINS_RIVALS:%=$(PAPER)/objects-table/metrics/%/samples.csv) --pictures $(foreach m,$(COINS_METHODS),$(PAPER_OBJECTS:%=$(COINS_IMAGES)/$(m)/%.png)))
$(PAPER)/objects-depth/image_table.yaml: configs/image_table/paper_objects_depth.yaml $(foreach m,$(filter-out fine,$(COINS_SHAPES)),$(PAPER)/objects-table/depth/$(m)/depth_metrics.yaml) | build
	$(call run,image_table,--config $< --samples $(foreach m,$(filter-out fine,$(COINS_SHAPES)),$(PAPER)/objects-table/depth/$(m)/samples.csv))

# The ablation: the same presses on other meshes, depth against the reference's.
define coins_mesh
$(foreach o,$(PAPER_ABLATED),$(call sample_rules,$(PAPER)/ablation/$(1)/$(o),$(o),$(OUT)/objects/$(o),configs/objects/embossed.yaml,mctac,$(1),$(COINS_MOTION),configs/press/default.yaml)
)
$(PAPER)/ablation/$(1)/images/collected: $(PAPER_ABLATED:%=$(PAPER)/ablation/$(1)/%/render/render.yaml)
	rm -rf $$(@D)
	mkdir -p $$(@D)
	for o in $(PAPER_ABLATED); do cp $(PAPER)/ablation/$(1)/$$$$o/render/$(COINS_LAST)/tactile.png $$(@D)/$$$$o.png; done
	touch $$@
$(PAPER)/ablation/metrics/$(1)/metrics.yaml: $(PAPER)/ablation/$(1)/images/collected $(PAPER)/ablation/fine/collected configs/metrics/paper_objects.yaml | build
	$$(call run,metrics,--config configs/metrics/paper_objects.yaml --images $(PAPER)/ablation/$(1)/images --reference $(PAPER)/ablation/fine)
$(PAPER)/ablation/$(1)/depth/depth_metrics.yaml: $(PAPER_ABLATED:%=$(PAPER)/ablation/$(1)/%/render/render.yaml) $(PAPER_ABLATED:%=$(PAPER)/objects/%/fine/render/render.yaml) configs/depth_metrics/default.yaml | build
	$$(call run,depth_metrics,--config configs/depth_metrics/default.yaml --images $(PAPER_ABLATED:%=$(PAPER)/ablation/$(1)/%/render/$(COINS_LAST)/depth.exr) \
	  --reference $(PAPER_ABLATED:%=$(PAPER)/objects/%/fine/render/$(COINS_LAST)/depth.exr) --rest $(PAPER)/objects/$(firstword $(PAPER_ABLATED))/fine/render/frame_0000/depth.exr)
endef
$(foreach m,$(PAPER_MESHES),$(eval $(call coins_mesh,$(m))))
$(PAPER)/ablation/fine/collected: $(PAPER_ABLATED:%=$(PAPER)/objects/%/fine/render/render.yaml)
	rm -rf $(@D)
	mkdir -p $(@D)
	for o in $(PAPER_ABLATED); do cp $(PAPER)/objects/$$o/fine/render/$(COINS_LAST)/tactile.png $(@D)/$$o.png; done
	touch $@

coins_ablation = $(foreach m,$(PAPER_MESHES),$(foreach o,$(PAPER_ABLATED),$(PAPER)/ablation/$(m)/$(o)/$(1)))
$(PAPER)/ablation/table/mesh_ablation.yaml: configs/mesh_ablation/$(PAPER_TABLES).yaml $(PAPER_MESHES:%=$(PAPER)/ablation/%/depth/depth_metrics.yaml) | build
	$(call run,mesh_ablation,--config $< --gel $(PAPER_MESHES:%=$(OUT)/gels/mctac-%/tetmesh.yaml) --press $(call coins_ablation,press/press.yaml) \
	  --render $(call coins_ablation,render/render.yaml) --depth $(PAPER_MESHES:%=$(PAPER)/ablation/%/depth/depth_metrics.yaml))
$(PAPER)/ablation/images/image_table.yaml: configs/image_table/$(PAPER_TABLES)_ablation.yaml $(PAPER_MESHES:%=$(PAPER)/ablation/metrics/%/metrics.yaml) | build
	$(call run,image_table,--config $< --samples $(PAPER_MESHES:%=$(PAPER)/ablation/metrics/%/samples.csv) \
	  --pictures $(PAPER_ABLATED:%=$(PAPER)/ablation/fine/%.png) $(foreach m,$(PAPER_MESHES),$(PAPER_ABLATED:%=$(PAPER)/ablation/$(m)/images/%.png)))

# What the image table cost.
coins_costs = $(foreach o,$(PAPER_OBJECTS),$(OUT)/emboss/$(o)/emboss.timings.yaml $(OUT)/objects/$(o)/decimate.timings.yaml \
  $(addprefix $(PAPER)/objects/$(o)/,tacipc/press/press.timings.yaml tacipc/render/render.timings.yaml tacchi/mpm/mpm.timings.yaml tacchi/render/render.timings.yaml \
  depth-based/legacy/baseline.timings.yaml fine/press/press.timings.yaml fine/render/render.timings.yaml)) $(OUT)/gels/mctac-$(PAPER_OURS)/tetmesh.timings.yaml
$(PAPER)/cost/cost_table.yaml: configs/cost_table/$(PAPER_TABLES).yaml $(PAPER)/objects-table/image_table.yaml | build
	$(call run,cost_table,--config $< --timings $(coins_costs))
