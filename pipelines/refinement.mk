# One scene with mesh, time step, reach of the barrier and sticking threshold refined one after the other.

REFINEMENT := $(OUT)/refinement
REFINEMENT_SCENE := configs/refinement/sphere_shear.yaml
REFINEMENT_STUDIES := mesh time_step d_hat speed_threshold
REFINEMENT_RECORDS := $(REFINEMENT_STUDIES:%=$(REFINEMENT)/%/refinement.yaml)

# The programs belong to the tests; never built beside another build in the same folder.
.PHONY: build-long
build-long: build | $(if $(filter build-all check check-slow,$(MAKECMDGOALS)),build-all) $(if $(filter verification verify-case,$(MAKECMDGOALS)),build-verify) $(if $(filter stress,$(MAKECMDGOALS)),build-stress)
	@cmake --build $(BUILD) --target marker_curve refinement refinement_table -j $(JOBS) -- --quiet

$(REFINEMENT_RECORDS): $(REFINEMENT)/%/refinement.yaml: $(REFINEMENT_SCENE) | build-long
	$(call run,refinement,--scene $< --study $*)

$(REFINEMENT)/page/refinement_table.yaml: $(REFINEMENT_RECORDS) | build-long
	$(call run,refinement_table,$(addprefix --result ,$(^D)))

.PHONY: refinement
refinement: $(REFINEMENT)/page/refinement_table.yaml ## Errors and orders over mesh, time step, d-hat, epsilon_v; writes docs/verification/refinement.md with its plots
	mkdir -p docs/verification
	cp $(REFINEMENT)/page/tables.md docs/verification/refinement.md
	cp $(REFINEMENT)/page/*.svg docs/verification/
	! grep -q '^  unsettled: [1-9]' $(REFINEMENT)/page/refinement_table.yaml
