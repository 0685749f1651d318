# One scene in which mesh, time step, reach of the barrier and sticking threshold are refined one after the other.

REFINEMENT := $(OUT)/refinement
REFINEMENT_SCENE := configs/studies/refinement/sphere_shear.yaml
REFINEMENT_STUDIES := mesh time_step d_hat speed_threshold
REFINEMENT_RECORDS := $(REFINEMENT_STUDIES:%=$(REFINEMENT)/%/refinement.yaml)
REFINEMENT_RECORD := $(REFINEMENT)/page/refinement_table.yaml

$(REFINEMENT_RECORDS): $(REFINEMENT)/%/refinement.yaml: $(REFINEMENT_SCENE) | build-verification
	$(call try,refinement,--scene $< --study $*)

$(REFINEMENT_RECORD): $(REFINEMENT_RECORDS) | build-verification
	$(call run,refinement_table,$(addprefix --result ,$(^D)))

.PHONY: refinement refinement-page
refinement-page: $(REFINEMENT_RECORDS) $(REFINEMENT_RECORD) # the studies too: make would not miss those that failed behind their table
	$(call copy_tables,refinement,$(REFINEMENT_RECORD))

refinement: refinement-page ## studies: Errors and orders over mesh, time step, d-hat, epsilon_v; writes OUT/docs/verification/refinement.md with its plots
	$(call holds,$(REFINEMENT_RECORD))
