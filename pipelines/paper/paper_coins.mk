# The image table on embossed objects: all of configs/objects/patterns pressed 0.5 mm into mctac by three simulators.
# Each is rendered through the same optics and through the published ones, and compared with a finer simulation with
# full light transport. Also the ablation of gel meshes. Variables are in paper.mk.
$(call uses,paper/paper)

COINS_SENSOR := configs/sensors/mctac.yaml
COINS_MOTION := configs/motions/press_0500um.yaml
COINS_LAST   := frame_0005# last frame of that motion
coins_mesh   = --object $(OUT)/objects/$(1)/object.ply
coins_object = $(coins_mesh) --object-config configs/objects/embossed.yaml

# $(call coins_sample,folder,object,mesh)
coins_sample = $(call sample_rules,$(1),name=$(2) object=$(OUT)/objects/$(2) object_yaml=configs/objects/embossed.yaml sensor=mctac mesh=$(3) \
  motion=$(COINS_MOTION) press=configs/press/frictionless.yaml)

# $(call coins_render,folder,press,mesh,configuration): another rendering of a press
define coins_render
$(1)/render.yaml: $(2)/press.yaml $(COINS_SENSOR) configs/render/$(4).yaml $$(REFERENCES) $(always) | build
	$$(call run,render,--press $(2) --gel $(OUT)/gels/mctac-$(3)/gel.msh --sensor $(COINS_SENSOR) --config configs/render/$(4).yaml)
endef

# Tacchi as published ends when its gel reaches the requested depth. Additional variants end when the object does, as in
# the other simulators, or have the other published densities of object points (6 per mm2 is its default).
$(foreach d,60 6,$(eval $(call changed_config,$(PAPER)/objects/tacchi_$(d).config.yaml,configs/rivals/mpm/legacy_mctac.yaml,object.samples_per_mm2=$(d))))
COINS_DEEP := $(PAPER)/objects/tacchi_deep.config.yaml
$(eval $(call changed_config,$(COINS_DEEP),configs/rivals/mpm/legacy_mctac.yaml,motion.depth_of=object))
# $(call coins_tacchi,folder,object,configuration)
define coins_tacchi
$(1)/mpm/mpm.yaml: $(OUT)/objects/$(2)/decimate.yaml $(COINS_SENSOR) $(COINS_MOTION) $(3) $(always) | build
	$$(call run,mpm,--name $(2) $(call coins_object,$(2)) --sensor $(COINS_SENSOR) --config $(3) --sample $(COINS_MOTION))
$(1)/render/render.yaml: $(1)/mpm/mpm.yaml $(COINS_SENSOR) configs/render/default.yaml $(always) | build
	$$(call run,render,--shapes $(1)/mpm/$(COINS_LAST)/seen_indentation.exr --sensor $(COINS_SENSOR) --config configs/render/default.yaml)
endef

# Membranes of methods without a gel, for each object at its last pose, along the camera's rays; TACTO has only the
# rigid object.
COINS_BLURRED := depth-based tacto taxim fots chen
$(eval $(call changed_config,$(PAPER)/objects/depth-based.config.yaml,configs/rivals/baseline/height_map.yaml,))
$(eval $(call changed_config,$(PAPER)/objects/tacto.config.yaml,configs/rivals/baseline/rigid.yaml,))
$(foreach m,taxim fots,$(eval $(call changed_config,$(PAPER)/objects/$(m).config.yaml,configs/rivals/baseline/$(m).yaml,-shading rays=refracted)))
$(eval $(call changed_config,$(PAPER)/objects/chen.config.yaml,configs/rivals/baseline/chen_2022.yaml,-shading))
# $(call coins_blurred,folder,object,method)
define coins_blurred
$(1)/$(3)/heights/baseline.yaml: $(1)/tacipc/press/press.yaml $(PAPER)/objects/$(3).config.yaml $(always) | build
	$$(call run,baseline,--config $(PAPER)/objects/$(3).config.yaml --sensor $(COINS_SENSOR) $(call coins_mesh,$(2)) --pose $(1)/tacipc/press/object_pose.npy)
$(1)/$(3)/render/render.yaml: $(1)/$(3)/heights/baseline.yaml configs/render/default.yaml $(always) | build
	$$(call run,render,--shapes $(1)/$(3)/heights/$(COINS_LAST)/indentation.exr --sensor $(COINS_SENSOR) --config configs/render/default.yaml)

endef

# $(call coins_rules,folder,object)
define coins_rules
$(call coins_sample,$(1)/tacipc,$(2),$(PAPER_OURS))
$(1)/fine/press/press.yaml: $(OUT)/objects/$(2)/decimate.yaml $(OUT)/gels/mctac-$(PAPER_FINE)/tetmesh.yaml $(COINS_SENSOR) $(COINS_MOTION) \
    configs/press/frictionless.yaml $(always) | build
	$$(call run,press,--name $(2) $(call coins_object,$(2)) --gel $(OUT)/gels/mctac-$(PAPER_FINE)/gel.msh --sensor $(COINS_SENSOR) \
	  --config configs/press/frictionless.yaml --sample $(COINS_MOTION))
$(call coins_render,$(1)/fine/render,$(1)/fine/press,$(PAPER_FINE),$(PAPER_LIGHT))
$(call coins_render,$(1)/noise/render,$(1)/fine/press,$(PAPER_FINE),default)
$(call coins_tacchi,$(1)/tacchi,$(2),configs/rivals/mpm/legacy_mctac.yaml)
$(call coins_tacchi,$(1)/tacchi_deep,$(2),$(COINS_DEEP))
$(call coins_tacchi,$(1)/tacchi_60,$(2),$(PAPER)/objects/tacchi_60.config.yaml)
$(call coins_tacchi,$(1)/tacchi_6,$(2),$(PAPER)/objects/tacchi_6.config.yaml)
$(1)/tacchi/legacy/baseline.yaml: $(1)/tacchi/render/render.yaml $(1)/tacipc/render/render.yaml configs/rivals/baseline/tacchi.yaml $(always) | build
	$$(call run,baseline,--config configs/rivals/baseline/tacchi.yaml --sensor $(COINS_SENSOR) --background $(1)/tacipc/render/frame_0000/tactile.png \
	  --depth $(1)/tacchi/render/frame_0001/depth.exr)
$(1)/tacipc/legacy/baseline.yaml: $(1)/tacipc/render/render.yaml configs/rivals/baseline/tacchi.yaml $(always) | build
	$$(call run,baseline,--config configs/rivals/baseline/tacchi.yaml --sensor $(COINS_SENSOR) --background $(1)/tacipc/render/frame_0000/tactile.png \
	  --depth $(1)/tacipc/render/$(COINS_LAST)/depth.exr)
$(foreach m,$(COINS_BLURRED),$(call coins_blurred,$(1),$(2),$(m)))
$(1)/depth-based/legacy/baseline.yaml: $(1)/tacipc/render/render.yaml configs/rivals/baseline/gomes_2021_own_front.yaml $(always) | build
	$$(call run,baseline,--config configs/rivals/baseline/gomes_2021_own_front.yaml --sensor $(COINS_SENSOR) \
	  --background $(1)/tacipc/render/frame_0000/tactile.png $(call coins_mesh,$(2)) --pose $(1)/tacipc/press/object_pose.npy)
$(1)/older_kernel/legacy/baseline.yaml: $(1)/tacipc/render/render.yaml configs/rivals/baseline/exponential_13_own_front.yaml $(always) | build
	$$(call run,baseline,--config configs/rivals/baseline/exponential_13_own_front.yaml --sensor $(COINS_SENSOR) \
	  --background $(1)/tacipc/render/frame_0000/tactile.png $(call coins_mesh,$(2)) --pose $(1)/tacipc/press/object_pose.npy)
endef
$(foreach o,$(PAPER_OBJECTS),$(eval $(call coins_rules,$(PAPER)/objects/$(o),$(o))))

# The ablation's objects are also pressed with a fifth of the barrier's width: the barrier keeps the reference's gel
# away from the object, which deepens it by that gap.
define coins_near
$(PAPER)/objects/$(1)/near/press/press.yaml: $(OUT)/objects/$(1)/decimate.yaml $(OUT)/gels/mctac-$(PAPER_FINE)/tetmesh.yaml $(COINS_SENSOR) \
    $(COINS_MOTION) configs/press/small_gap.yaml $(always) | build
	$$(call run,press,--name $(1) $(call coins_object,$(1)) --gel $(OUT)/gels/mctac-$(PAPER_FINE)/gel.msh --sensor $(COINS_SENSOR) \
	  --config configs/press/small_gap.yaml --sample $(COINS_MOTION))
$(call coins_render,$(PAPER)/objects/$(1)/near/render,$(PAPER)/objects/$(1)/near/press,$(PAPER_FINE),default)
endef
$(foreach o,$(PAPER_ABLATED),$(eval $(call coins_near,$(o))))

# Pictures of each method under the objects' names, so that all methods are compared alike. Each entry is the method's
# folder below that of the object, and its picture.
COINS_IMAGES := $(PAPER)/objects-table/images
COINS_FROM_fine                := fine/render $(COINS_LAST)/tactile.png
COINS_FROM_noise               := noise/render $(COINS_LAST)/tactile.png
COINS_FROM_rest                := noise/render frame_0000/tactile.png
COINS_FROM_tacipc              := tacipc/render $(COINS_LAST)/tactile.png
COINS_FROM_tacchi              := tacchi/render frame_0001/tactile.png
COINS_FROM_tacchi_deep         := tacchi_deep/render frame_0001/tactile.png
COINS_FROM_tacchi_60           := tacchi_60/render frame_0001/tactile.png
COINS_FROM_tacchi_6            := tacchi_6/render frame_0001/tactile.png
$(foreach m,$(COINS_BLURRED),$(eval COINS_FROM_$(m) := $(m)/render frame_0001/tactile.png))
COINS_FROM_tacipc_legacy       := tacipc/legacy frame_0000/tactile.png
COINS_FROM_tacchi_legacy       := tacchi/legacy frame_0000/tactile.png
COINS_FROM_depth-based_legacy  := depth-based/legacy $(COINS_LAST)/tactile.png
COINS_FROM_older_kernel_legacy := older_kernel/legacy $(COINS_LAST)/tactile.png
COINS_METHODS := fine noise rest tacipc tacchi tacchi_deep tacchi_60 tacchi_6 $(COINS_BLURRED) \
  tacipc_legacy tacchi_legacy depth-based_legacy older_kernel_legacy
COINS_SHAPES  := fine tacipc tacchi tacchi_deep tacchi_60 tacchi_6 $(COINS_BLURRED)# methods whose depth is compared
# Methods compared with the reference's gel in their own light.
COINS_IN_ONE_LIGHT := tacipc tacchi tacchi_deep tacchi_60 tacchi_6 $(COINS_BLURRED) rest

coins_record = $(firstword $(COINS_FROM_$(1)))/$(if $(filter render,$(notdir $(firstword $(COINS_FROM_$(1))))),render,baseline).yaml
define coins_images
$(COINS_IMAGES)/$(1)/collected: $(foreach o,$(PAPER_OBJECTS),$(PAPER)/objects/$(o)/$(call coins_record,$(1))) pipelines/paper/paper_coins.mk
	rm -rf $$(@D)
	mkdir -p $$(@D)
	for o in $(PAPER_OBJECTS); do from=$(PAPER)/objects/$$$$o/$(firstword $(COINS_FROM_$(1))); cp $$$$from/$(lastword $(COINS_FROM_$(1))) $$(@D)/$$$$o.png; \
	  $(if $(filter $(1),$(COINS_SHAPES)),cp $$$$from/$(patsubst %tactile.png,%depth.exr,$(lastword $(COINS_FROM_$(1)))) $$(@D)/$$$$o.exr;) done
	touch $$@
$(PAPER)/objects-table/metrics/$(1)/metrics.yaml: $(COINS_IMAGES)/$(1)/collected $(COINS_IMAGES)/fine/collected \
    configs/studies/paper/metrics_objects.yaml $(always) | build
	$$(call run,metrics,--config configs/studies/paper/metrics_objects.yaml --images $(COINS_IMAGES)/$(1) --reference $(COINS_IMAGES)/fine)
$(PAPER)/objects-table/depth/$(1)/metrics.yaml: $(COINS_IMAGES)/$(1)/collected $(COINS_IMAGES)/fine/collected configs/metrics/depth.yaml $(always) | build
	$$(call run,metrics,--config configs/metrics/depth.yaml --images $(PAPER_OBJECTS:%=$(COINS_IMAGES)/$(1)/%.exr) \
	  --reference $(PAPER_OBJECTS:%=$(COINS_IMAGES)/fine/%.exr) --rest $(PAPER)/objects/$(firstword $(PAPER_OBJECTS))/fine/render/frame_0000/depth.exr)
$(PAPER)/objects-near/depth/$(1)/metrics.yaml: $(COINS_IMAGES)/$(1)/collected $(PAPER_ABLATED:%=$(PAPER)/objects/%/near/render/render.yaml) \
    configs/metrics/depth.yaml $(always) | build
	$$(call run,metrics,--config configs/metrics/depth.yaml --images $(PAPER_ABLATED:%=$(COINS_IMAGES)/$(1)/%.exr) \
	  --reference $(PAPER_ABLATED:%=$(PAPER)/objects/%/near/render/$(COINS_LAST)/depth.exr) \
	  --rest $(PAPER)/objects/$(firstword $(PAPER_ABLATED))/near/render/frame_0000/depth.exr)
endef
$(foreach m,$(COINS_METHODS),$(eval $(call coins_images,$(m))))

define coins_in_one_light
$(PAPER)/objects-table/metrics/$(1)_one_light/metrics.yaml: $(COINS_IMAGES)/$(1)/collected $(COINS_IMAGES)/noise/collected \
    configs/studies/paper/metrics_objects.yaml $(always) | build
	$$(call run,metrics,--config configs/studies/paper/metrics_objects.yaml --images $(COINS_IMAGES)/$(1) --reference $(COINS_IMAGES)/noise)
endef
$(foreach m,$(COINS_IN_ONE_LIGHT),$(eval $(call coins_in_one_light,$(m))))

COINS_RIVALS := $(filter-out fine tacchi_60 tacchi_6 tacto taxim fots chen,$(COINS_METHODS)) $(COINS_IN_ONE_LIGHT:%=%_one_light)
$(PAPER)/objects-table/tabulate.yaml: configs/studies/paper/$(PAPER_TABLES)/objects.yaml $(COINS_RIVALS:%=$(PAPER)/objects-table/metrics/%/metrics.yaml) \
    $(always) | build
	$(call run,tabulate,--config $< --samples $(foreach m,$(COINS_RIVALS),$(m)=$(PAPER)/objects-table/metrics/$(m)/samples.csv) \
	  --pictures $(foreach m,$(COINS_METHODS),$(PAPER_OBJECTS:%=$(m)=$(COINS_IMAGES)/$(m)/%.png)))
$(PAPER)/objects-depth/tabulate.yaml: configs/studies/paper/tables/objects_depth.yaml \
    $(foreach m,$(filter-out fine,$(COINS_SHAPES)),$(PAPER)/objects-table/depth/$(m)/metrics.yaml) $(always) | build
	$(call run,tabulate,--config $< --samples $(foreach m,$(filter-out fine,$(COINS_SHAPES)),$(m)=$(PAPER)/objects-table/depth/$(m)/samples.csv))

$(PAPER)/objects-near/table/tabulate.yaml: configs/studies/paper/tables/near_depth.yaml $(COINS_SHAPES:%=$(PAPER)/objects-near/depth/%/metrics.yaml) \
    $(always) | build
	$(call run,tabulate,--config $< --samples $(foreach m,$(COINS_SHAPES),$(m)=$(PAPER)/objects-near/depth/$(m)/samples.csv))

# The ablation: some of the objects on other meshes, compared with the finest, all with the same barrier, light and
# noise.
define coins_mesh
$(foreach o,$(PAPER_ABLATED),$(call coins_sample,$(PAPER)/ablation/$(1)/$(o),$(o),$(1))
)
endef
# Folder of the rendering of a press on a mesh, $(call coins_seen,mesh,object); for the finest mesh it is one of those
# above.
coins_seen = $(if $(filter $(PAPER_FINE),$(1)),$(PAPER)/objects/$(2)/noise/render,$(PAPER)/ablation/$(1)/$(2)/render)
coins_depths = $(foreach o,$(PAPER_ABLATED),$(call coins_seen,$(1),$(o))/$(COINS_LAST)/depth.exr)
define coins_mesh_images
$(PAPER)/ablation/$(1)/images/collected: $(foreach o,$(PAPER_ABLATED),$(call coins_seen,$(1),$(o))/render.yaml)
	rm -rf $$(@D)
	mkdir -p $$(@D)
	for o in $(PAPER_ABLATED); do cp $(call coins_seen,$(1),$$$$o)/$(COINS_LAST)/tactile.png $$(@D)/$$$$o.png; done
	touch $$@
endef
define coins_compared_mesh
$(PAPER)/ablation/metrics/$(1)/metrics.yaml: $(PAPER)/ablation/$(1)/images/collected $(PAPER)/ablation/$(PAPER_FINE)/images/collected \
    configs/studies/paper/metrics_objects.yaml $(always) | build
	$$(call run,metrics,--config configs/studies/paper/metrics_objects.yaml --images $(PAPER)/ablation/$(1)/images \
	  --reference $(PAPER)/ablation/$(PAPER_FINE)/images)
$(PAPER)/ablation/$(1)/depth/metrics.yaml: $(foreach m,$(1) $(PAPER_FINE),$(PAPER)/ablation/$(m)/images/collected) configs/metrics/depth.yaml $(always) | build
	$$(call run,metrics,--config configs/metrics/depth.yaml --images $(call coins_depths,$(1)) \
	  --reference $(call coins_depths,$(PAPER_FINE)) --rest $(call coins_seen,$(PAPER_FINE),$(firstword $(PAPER_ABLATED)))/frame_0000/depth.exr)
endef
$(foreach m,$(PAPER_MESHES),$(eval $(call coins_mesh,$(m)))$(eval $(call coins_compared_mesh,$(m))))
$(foreach m,$(PAPER_MESHES) $(PAPER_FINE),$(eval $(call coins_mesh_images,$(m))))

$(PAPER)/ablation/table/tabulate.yaml: configs/studies/paper/$(PAPER_TABLES)/meshes.yaml $(PAPER_MESHES:%=$(PAPER)/ablation/%/depth/metrics.yaml) \
    $(always) | build
	$(call run,tabulate,--config $< --records $(foreach m,$(PAPER_MESHES),$(addprefix $(m)=,\
	  $(OUT)/gels/mctac-$(m)/tetmesh.yaml $(PAPER)/ablation/$(m)/depth/metrics.yaml \
	  $(foreach o,$(PAPER_ABLATED),$(PAPER)/ablation/$(m)/$(o)/press/press.yaml $(PAPER)/ablation/$(m)/$(o)/render/render.yaml))))
$(PAPER)/ablation/images/tabulate.yaml: configs/studies/paper/$(PAPER_TABLES)/mesh_images.yaml \
    $(PAPER_MESHES:%=$(PAPER)/ablation/metrics/%/metrics.yaml) $(always) | build
	$(call run,tabulate,--config $< --samples $(foreach m,$(PAPER_MESHES),$(m)=$(PAPER)/ablation/metrics/$(m)/samples.csv) \
	  --pictures $(foreach m,$(PAPER_FINE) $(PAPER_MESHES),$(PAPER_ABLATED:%=$(m)=$(PAPER)/ablation/$(m)/images/%.png)))

# Cost of the image table.
coins_costs = $(foreach o,$(PAPER_OBJECTS),$(OUT)/emboss/$(o)/emboss.timings.yaml $(OUT)/objects/$(o)/decimate.timings.yaml \
  $(addprefix $(PAPER)/objects/$(o)/,tacipc/press/press.timings.yaml tacipc/render/render.timings.yaml \
  tacchi/mpm/mpm.timings.yaml tacchi/render/render.timings.yaml \
  depth-based/legacy/baseline.timings.yaml fine/press/press.timings.yaml fine/render/render.timings.yaml)) $(OUT)/gels/mctac-$(PAPER_OURS)/tetmesh.timings.yaml
$(PAPER)/cost/tabulate.yaml: configs/studies/paper/$(PAPER_TABLES)/costs.yaml $(PAPER)/objects-table/tabulate.yaml $(always) | build
	$(call run,tabulate,--config $< --timings $(coins_costs))

$(eval $(call paper_fragment,objects,$(PAPER)/objects-table/tabulate.yaml,yes))
$(eval $(call paper_fragment,depth,$(PAPER)/objects-depth/tabulate.yaml))
$(eval $(call paper_fragment,near,$(PAPER)/objects-near/table/tabulate.yaml))
$(eval $(call paper_fragment,meshes,$(PAPER)/ablation/table/tabulate.yaml,yes))
$(eval $(call paper_fragment,mesh_images,$(PAPER)/ablation/images/tabulate.yaml,yes))
$(eval $(call paper_fragment,cost,$(PAPER)/cost/tabulate.yaml))
.PHONY: paper-coins paper-coins-folders
paper-coins: paper-coins-folders $(addprefix paper-fragment-,objects depth near meshes mesh_images cost)
paper-coins-folders:
	$(call paper_folders,coins,$(foreach o,$(PAPER_OBJECTS),$(OUT)/emboss/$(o) $(OUT)/objects/$(o) $(PAPER)/objects/$(o)) \
	  $(foreach m,$(PAPER_OURS) $(PAPER_FINE) $(PAPER_MESHES),$(OUT)/gels/mctac-$(m)) \
	  $(COINS_RIVALS:%=$(PAPER)/objects-table/metrics/%) $(foreach m,$(COINS_SHAPES),$(PAPER)/objects-table/depth/$(m) $(PAPER)/objects-near/depth/$(m)) \
	  $(foreach m,$(PAPER_MESHES),$(PAPER)/ablation/metrics/$(m) $(PAPER)/ablation/$(m)/depth $(PAPER_ABLATED:%=$(PAPER)/ablation/$(m)/%)) \
	  $(addprefix $(PAPER)/,objects-depth objects-near/table ablation/table ablation/images cost))
