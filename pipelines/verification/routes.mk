# Compares the default route with the one that factorises every linear system, over every mesh of SHARED in five poses
# on a gel of 12k vertices: does each sample converge, and to the same result? An interrupted run resumes; presses may
# run in parallel (JOBS).
$(call uses,verification/bench sample/objects)

ROUTES := $(OUT)/routes
POSES := $(basename $(notdir $(wildcard configs/studies/speed/poses/*.yaml)))
ROUTES_RECORD := $(ROUTES)/table/routes_table.yaml

# $(call route_rule,object,pose,route)
define route_rule
$(ROUTES)/runs/12k-$(1)-$(2)-$(3)/press.yaml: $(BENCH)/gels/12k/tetmesh.yaml $(TABLE)/objects/$(1)/decimate.yaml $(BENCH)/configs/sweep_$(3).yaml \
    configs/studies/speed/poses/$(2).yaml | build
	@mkdir -p $$(@D)
	$$(call try,press,--name 12k-$(1)-$(2)-$(3) --gel $(BENCH)/gels/12k/gel.msh --object $(TABLE)/objects/$(1)/object.ply \
	  --object-config configs/objects/printed_indenter.yaml --sensor configs/sensors/mctac.yaml --config $(BENCH)/configs/sweep_$(3).yaml \
	  --sample configs/studies/speed/poses/$(2).yaml)
ROUTE_RUNS += $(ROUTES)/runs/12k-$(1)-$(2)-$(3)
endef
ROUTE_RUNS :=
$(foreach f,$(TABLE_FILES),$(foreach p,$(POSES),$(foreach r,fast direct,$(eval $(call route_rule,$(call name_of,$(f)),$(p),$(r))))))

$(ROUTES_RECORD): $(addsuffix /press.yaml,$(ROUTE_RUNS)) | build-bench
	$(call run,routes_table,--limits configs/studies/speed/routes.yaml $(addprefix --press ,$(ROUTE_RUNS)))

.PHONY: routes
routes: $(ROUTES_RECORD) ## studies: Every mesh of SHARED in five poses, default route against factorisation; writes OUT/docs/routes.md (half an hour; resumes)
	$(call to_docs,$(ROUTES)/table/routes.md)
	@cat $(DOCS)/routes.md
	$(call holds,$(ROUTES_RECORD))
