# Depth from tactile images, the paper's third task: make -f Makefile.data depth-benchmark (docs/depth-results.md).
# Networks are trained on images of three simulators, of the same objects in the same poses. Each simulator uses the
# light that was fitted on its own membranes of the same balls. The networks are evaluated on the photographs of
# sim2real.
$(call uses,paper/sim2real paper/paper_real dataset/depthnet)

DEPTH       := $(OUT)/depth
DEPTH_POSES  ?= 20#         depth-benchmark: poses of each object
DEPTH_SEEDS  ?= 1 2 3 4 5#  networks of each simulator
DEPTH_EPOCHS ?= 15#         epochs of each training
$(foreach v,DEPTH_POSES DEPTH_SEEDS DEPTH_EPOCHS,$(eval override $(v) := $(strip $($(v)))))

DEPTH_PRINTED := cone cross_lines curved_surface cylinder cylinder_shell cylinder_side dot_in dots flat_slab hexagon line moon parallel_lines sphere2 triangle
DEPTH_BALLS   := 1.5 2 2.5 4 5 7# radius, mm
DEPTH_METHODS := tacipc tacchi depth-based
DEPTH_MADE    := $(DEPTH_PRINTED) $(DEPTH_BALLS:%=ball_%)

# Networks are trained for the sensor of these photographs. CASES= selects the photographs for evaluation, of the same
# sensor.
DEPTH_CASES  := configs/studies/sim2real/gelsight_sim2real.yaml
DEPTH_SENSOR := $(OUT)/sim2real/$(basename $(notdir $(DEPTH_CASES)))/calibrate/sensor.yaml
DEPTH_DATA   := $(DEPTH)/datasets/depth
packages_for_depth-benchmark := depthnet predict
packages_for_depth-quick     := depthnet predict loaders

# Impossible settings are refused before hours of simulation; failed samples are left out if they are few.
depth_lists = bash pipelines/paper/depth_lists.sh $(DEPTH) $(DEPTH_DATA) $(BIN)/tacipc
.PHONY: depth-benchmark depth-objects depth-rivals depth-networks depth-quick
depth-benchmark: ## studies: Networks trained on three simulators read depth from photographs [CASES=] (needs SHARED; hours); writes OUT/docs/depth-results.md
depth-benchmark: | build
	$(depthnet_is_built)
	@[ -z "$$($(BIN)/tacipc get '$(CASES)' circles --default '')" ] || { echo "depth-benchmark: $(CASES) tells no depths" >&2; exit 2; }
	$(call make_again,REBUILD=no sim2real-page)
	$(if $(filter $(DEPTH_CASES),$(CASES)),,$(call make_again,REBUILD=no CASES=$(DEPTH_CASES) sim2real-page))
	$(call make_again,REBUILD=no CASES=$(DEPTH_CASES) paper-real)
	$(call make_again,REBUILD=no depth-objects)
	$(call make_again,REBUILD=no dataset CONFIG=$(DEPTH)/depth.yaml OUT=$(DEPTH)) || $(depth_lists) pressed tacipc
	$(call make_again,REBUILD=no CASES=$(DEPTH_CASES) -k depth-rivals) || $(depth_lists) lists $(DEPTH_METHODS)
	$(call make_again,REBUILD=no depth-networks JOBS=1 THREADS=$(JOBS))

depth-quick: ## development: A small network on 48 images and on shuffled ones, judged on 24 others and on photographs unlike these (two minutes)
depth-quick: | build
	bash tests/pipeline/depthnet_test.sh '$(CURDIR)' '$(abspath $(BUILD))'

# All objects in one folder, prints with the rounded edges of those on the photographs, and the dataset's file.
define depth_ball
$(DEPTH)/indenters/ball_$(1).yaml: FORCE
	$$(call replace_if_changed,ball: {radius_mm: $(1)$$(comma) edge_mm: 0.25})
$(DEPTH)/indenters/ball_$(1)/indenter.yaml: $(DEPTH)/indenters/ball_$(1).yaml $(always) | build
	$$(call run,indenter,--config $$<)
endef
$(foreach r,$(DEPTH_BALLS),$(eval $(call depth_ball,$(r))))
$(DEPTH_PRINTED:%=$(DEPTH)/indenters/%/indenter.yaml): $(DEPTH)/indenters/%/indenter.yaml: $(SHARED)/data/printed_indenters/%.stl \
    configs/studies/depth/printed.yaml $(always) | build
	$(call run,indenter,--config configs/studies/depth/printed.yaml --mesh $<)
$(DEPTH_MADE:%=$(DEPTH)/meshes/%.ply): $(DEPTH)/meshes/%.ply: $(DEPTH)/indenters/%/indenter.yaml
	@mkdir -p $(@D)
	cp $(<D)/object.ply $@.new && mv $@.new $@
$(eval $(call changed_config,$(DEPTH)/render.yaml,configs/render/many_frames.yaml,frames=last))
$(eval $(call changed_config,$(DEPTH)/depth.yaml,configs/studies/depth/dataset.yaml,sensors.sensor=$(abspath $(DEPTH_SENSOR)) \
  sensors.mesh=$(abspath configs/studies/depth/gel.yaml) objects[0].meshes=$(abspath $(DEPTH))/meshes \
  objects[1].meshes=$(abspath $(SHARED))/data/tacipc_release/objects render=$(abspath $(DEPTH))/render.yaml motions[0].samples=$(DEPTH_POSES)))
depth-objects: $(DEPTH_MADE:%=$(DEPTH)/meshes/%.ply) $(DEPTH)/depth.yaml $(DEPTH)/render.yaml

ifneq ($(filter depth-rivals,$(MAKECMDGOALS)),)
# id|object|folder
DEPTH_ROWS := $(shell $(BIN)/tacipc table $(DEPTH_DATA)/plan/samples.csv --columns id,object,folder | tr '\t' '|')
ifeq ($(DEPTH_ROWS),)
  $(error $(DEPTH_DATA)/plan/samples.csv names no samples)
endif
depth_last := $(shell printf frame_%04d $$($(BIN)/tacipc get configs/studies/depth/dataset.yaml motions[0].motion.steps))
depth_render = $$(call run,render,--shapes $(1) --sensor $(2)/sensor.yaml --config $(DEPTH)/render.yaml --maps $(DEPTH_DATA)/maps.yaml)
# $(call depth_sample,id,object,folder): the same pose by material points, and by the rigid object's depth.
define depth_sample
$(DEPTH)/tacchi/$(1)/mpm.yaml: $(DEPTH_DATA)/$(3)/press/press.yaml $(PAPER_CONFIGS)/mpm.yaml $(CASES_SENSOR)
	$$(call run,mpm,--name $(1) --config $(PAPER_CONFIGS)/mpm.yaml --sensor $(CASES_SENSOR) --sample $(DEPTH_DATA)/$(3)/sample.yaml \
	  --object $(DEPTH_DATA)/objects/$(2)/object.ply --object-config $(DEPTH_DATA)/objects/$(2)/object.yaml --log-level warning)
$(DEPTH)/tacchi/$(1)/render/render.yaml: $(DEPTH)/tacchi/$(1)/mpm.yaml $(PAPER_REAL)/tacchi/calibrate/calibrate.yaml $(DEPTH)/render.yaml
	$(call depth_render,$(DEPTH)/tacchi/$(1)/$(depth_last)/seen_indentation.exr,$(PAPER_REAL)/tacchi/calibrate)
$(DEPTH)/depth-based/$(1)/baseline.yaml: $(DEPTH_DATA)/$(3)/press/press.yaml $(CASES_BASELINE) $(SIM2REAL)/rival/calibrate/calibrate.yaml
	$$(call run,baseline,--config $(CASES_BASELINE) --sensor $(CASES_SENSOR) --object $(DEPTH_DATA)/objects/$(2)/object.ply \
	  --pose $(DEPTH_DATA)/$(3)/press/object_pose.npy)
$(DEPTH)/depth-based/$(1)/render/render.yaml: $(DEPTH)/depth-based/$(1)/baseline.yaml $(SIM2REAL)/rival/calibrate/calibrate.yaml $(DEPTH)/render.yaml
	$(call depth_render,$(DEPTH)/depth-based/$(1)/$(depth_last)/indentation.exr,$(SIM2REAL)/rival/calibrate)
# A press that failed has no samples of the other simulators.
$(DEPTH_DATA)/$(3)/press/press.yaml:
	@echo "$$@: was not made" >&2; exit 1
endef
depth_field = $(word $(1),$(subst |, ,$(2)))
$(foreach r,$(DEPTH_ROWS),$(eval $(call depth_sample,$(call depth_field,1,$(r)),$(call depth_field,2,$(r)),$(call depth_field,3,$(r)))))
depth-rivals: $(foreach r,$(DEPTH_ROWS),$(foreach m,tacchi depth-based,$(DEPTH)/$(m)/$(call depth_field,1,$(r))/render/render.yaml))
endif

ifneq ($(filter depth-networks,$(MAKECMDGOALS)),)
# Folders of render by simulator and split, for the samples that every simulator has made.
$(DEPTH)/lists/made.txt: FORCE
	@$(depth_lists) lists $(DEPTH_METHODS)
# $(call depth_network,folder,simulator,changes of configs/depthnet/default.yaml[,4: only the first quarter of the training's list])
define depth_network
$(call changed_config,$(1)/network.yaml,configs/depthnet/default.yaml,$(3))
$(1)/depthnet.yaml: $(1)/network.yaml $(DEPTH)/lists/made.txt $(always) | build
	mapfile -t train < $(DEPTH)/lists/$(2)-train.txt; \
	  train=("$$$${train[@]:0:($$$${#train[@]} + $(or $(4),1) - 1) / $(or $(4),1)}"); mapfile -t val < $(DEPTH)/lists/$(2)-val.txt; \
	$$(call run,depthnet,--config $$< --renders "$$$${train[@]}" --validation "$$$${val[@]}")
endef
# Networks of a method, one per seed. Additional ones: `quarter`, trained on a quarter of the poses, seen four times as
# often; `shuffled`, the control with shuffled pairs.
DEPTH_BESIDE := quarter shuffled
depth_seeds = $(if $(filter $(DEPTH_BESIDE) nothing,$(1)),1,$(DEPTH_SEEDS))
$(foreach m,$(DEPTH_METHODS),$(foreach s,$(DEPTH_SEEDS),\
  $(eval $(call depth_network,$(DEPTH)/networks/$(m)/$(s),$(m),seed=$(s) schedule.epochs=$(DEPTH_EPOCHS)))))
$(eval $(call depth_network,$(DEPTH)/networks/shuffled/1,tacipc,seed=1 schedule.epochs=$(DEPTH_EPOCHS) +shuffle_pairs=true))
$(eval $(call depth_network,$(DEPTH)/networks/quarter/1,tacipc,seed=1 schedule.epochs=$(shell echo $$((4 * $(DEPTH_EPOCHS)))) schedule.warmup_epochs=4,4))

# Images for evaluation: photographs, and TacIPC's images of the same contacts. There are two references: TacIPC's
# membrane, and the object's surface inside the gel.
DEPTH_READ := $(DEPTH)/read/$(cases_name)
$(DEPTH)/rest.exr: $(DEPTH)/lists/made.txt
	cp "$$(head -n 1 $(DEPTH)/lists/tacipc-train.txt)/frame_0000/depth.exr" $@.new && mv $@.new $@
define depth_surface
$(DEPTH_READ)/surface/$(1)/baseline.yaml: $(SIM2REAL)/ours/$(1)/shade.yaml configs/studies/depth/surface.yaml $(always) | build
	$$(call run,baseline,--config configs/studies/depth/surface.yaml --sensor $(CASES_SENSOR) $(call cases_posed,$(1)))
endef
$(foreach o,$(CASES_OBJECTS),$(eval $(call depth_surface,$(o))))
depth_truth_surface  := $(foreach o,$(CASES_OBJECTS),$(call cases_frames,$(o),$(DEPTH_READ)/surface/$(o),0,depth.exr))
depth_truth_membrane := $(foreach o,$(CASES_OBJECTS),$(foreach i,$(CASES_IMAGES_$(o)),$(SIM2REAL)/ours/$(o)/depth/$(i).exr))
depth_truths := $(CASES_OBJECTS:%=$(SIM2REAL)/ours/%/shade.yaml) $(CASES_OBJECTS:%=$(DEPTH_READ)/surface/%/baseline.yaml)
# Photographs under the names of TacIPC's images, because a prediction is named after its image.
$(DEPTH_READ)/images/copied.txt: $(CASES_REAL)
	mkdir -p $(@D)
	$(foreach i,$(CASES_ALL),cp $(call cases_photograph,$(i)) $(@D)/$(i).png;)
	echo $(CASES_ALL) > $@
depth_images_photographs := $(CASES_ALL:%=$(DEPTH_READ)/images/%.png)
depth_images_simulated   := $(call sim2real_images,ours)

# $(call depth_read,images,network)
define depth_read
$(DEPTH_READ)/$(1)/$(2)/predict.yaml: $(DEPTH)/networks/$(2)/depthnet.yaml $(DEPTH)/rest.exr $(depth_truths) $(DEPTH_READ)/images/copied.txt $(always) | build
	@compgen -G '$(DEPTH)/networks/$(2)/model_*.onnx' > /dev/null \
	  || { echo "$(DEPTH)/networks/$(2): has no model_*.onnx: remove the folder, it was trained by an earlier version" >&2; exit 1; }
	$$(call run,predict,--model $(DEPTH)/networks/$(2)/model_*.onnx --background $(cases_background) --images $(depth_images_$(1)) \
	  --rest $(DEPTH)/rest.exr --truth $(depth_truth_membrane))
endef
$(foreach i,photographs simulated,$(foreach m,$(DEPTH_METHODS) $(DEPTH_BESIDE),$(foreach s,$(call depth_seeds,$(m)),$(eval $(call depth_read,$(i),$(m)/$(s))))))
# Baseline `nothing`: predicts that nothing touches the gel.
$(DEPTH_READ)/%/nothing/1/predict.yaml: $(DEPTH)/rest.exr $(depth_truths)
	mkdir -p $(@D)/depth
	for image in $(CASES_ALL); do cp $(DEPTH)/rest.exr $(@D)/depth/$$image.exr; done
	touch $@
# $(call depth_judge,truth)
define depth_judge
$(DEPTH_READ)/%/$(1)/metrics.yaml: $(DEPTH_READ)/%/predict.yaml configs/studies/depth/metrics.yaml $(always) | build
	$$(call run,metrics,--config configs/studies/depth/metrics.yaml --images $(CASES_ALL:%=$$(<D)/depth/%.exr) --reference $(depth_truth_$(1)) \
	  --rest $(DEPTH)/rest.exr --surface $(depth_truth_surface))
endef
$(foreach t,membrane surface,$(eval $(call depth_judge,$(t))))

# $(call depth_table,images,truth,title)
depth_scores = $(foreach m,$(DEPTH_METHODS) $(DEPTH_BESIDE) nothing,$(foreach s,$(call depth_seeds,$(m)),$(m)=$(DEPTH_READ)/$(1)/$(m)/$(s)/$(2)))
define depth_table
$(DEPTH_READ)/tables/$(1)_$(2).yaml: configs/studies/depth/table.yaml FORCE | build
	$$(call replace_if_changed_by,$(BIN)/tacipc set $$< 'title="$(3)"')
$(DEPTH_READ)/tables/$(1)_$(2)/tabulate.yaml: $(DEPTH_READ)/tables/$(1)_$(2).yaml \
    $(foreach s,$(call depth_scores,$(1),$(2)/metrics.yaml),$(lastword $(subst =, ,$(s)))) $(always) | build
	$$(call run,tabulate,--config $$< --samples $(call depth_scores,$(1),$(2)/samples.csv))
DEPTH_TABLES += $(1)_$(2)
endef
$(eval $(call depth_table,photographs,membrane,Photographs against our membrane))
$(eval $(call depth_table,photographs,surface,Photographs against the surface of the object))
$(eval $(call depth_table,simulated,membrane,Our images of the same contacts against our membrane))

# Page of the shipped photographs, with the sheet of one network of each simulator.
depth-networks: $(DEPTH_TABLES:%=$(DEPTH_READ)/tables/%/tabulate.yaml)
ifneq ($(and $(filter $(DEPTH_CASES),$(CASES)),$(wildcard docs/depth-results.md)),)
	@$(call fill_docs,depth-results.md,$(foreach t,$(DEPTH_TABLES),$(t)=$(DEPTH_READ)/tables/$(t)/table.md))
	@mkdir -p $(DOCS)/depth_results
	@for m in $(DEPTH_METHODS); do cp $(DEPTH_READ)/photographs/$$m/$(firstword $(DEPTH_SEEDS))/sheet.png $(DOCS)/depth_results/$$m.png; done
	$(call docs_look,depth-results.md)
endif
	@echo "Look at $(DEPTH_READ)/tables/*/table.md and $(DEPTH_READ)/photographs/*/*/sheet.png"
endif
