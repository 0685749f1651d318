# Compares the press with closed forms, measurements and other solvers: one folder and record per case, then one page.
# Campaigns that answer one question each are long rows of the page; their targets are in refinement.mk, stress.mk and
# board3.mk.

VERIFICATION := $(OUT)/verification
VERIFICATION_CASES := $(sort $(basename $(notdir $(wildcard configs/studies/verification/*.yaml))))
VERIFICATION_RESULTS := $(VERIFICATION_CASES:%=$(VERIFICATION)/%)

# Long rows that this call makes; the page waits for them. Without SHARED board3 is skipped, like cases.
LONG_ROWS := $(filter closed-forms free-object refinement stress board3,$(MAKECMDGOALS) \
  $(if $(filter verification,$(MAKECMDGOALS)),closed-forms free-object refinement stress $(if $(wildcard $(SHARED)),board3)))
LONG_RECORDS = $(CLOSED_FORMS_RECORD) $(FREE_OBJECT_RECORD) $(REFINEMENT_RECORD) $(STRESS_RECORD) $(BOARD3_RECORD)

# Must not be built in parallel with another build in the same folder.
.PHONY: build-verification build-closed-forms build-free-object
build-verification: build | $(if $(filter build-all check check-slow,$(MAKECMDGOALS)),build-all)
	@$(call compile,$(BUILD),verify verify_table stress_case stress_table refinement refinement_table marker_curve compare_simulators)
build-closed-forms: build-verification with-tests # the closed forms are tests
	@$(call compile,$(BUILD),verification_test)
build-free-object: build-closed-forms
	@$(call compile,$(BUILD),press_test verification_slow_test)
packages_for_closed-forms := tests
packages_for_free-object := tests
packages_for_verification := tests

$(VERIFICATION)/%/verify.yaml: configs/studies/verification/%.yaml | build-verification
	TACIPC_SHARED='$(SHARED)' $(call run,verify,--case $<)

# $(call record_tests,record,program=filter …): runs tests of some programs, and writes the number of passed tests to a
# long row's record.
define record_tests
	mkdir -p $(dir $(1))
	rm -f $(1) $(dir $(1))log.txt $(dir $(1))*.json
	holds=true; passed=0; failed=0; \
	for tests in $(foreach tests,$(2),'$(tests)'); do \
	  json=$(dir $(1))$$(basename "$${tests%%=*}").json; \
	  $(BUILD)/tests/$${tests%%=*} --gtest_filter="$${tests#*=}" --gtest_brief=1 --gtest_output=json:$$json >> $(dir $(1))log.txt 2>&1 || holds=false; \
	  { read -r ran; read -r missed; } < <($(BIN)/tacipc get $$json tests failures --default 0); \
	  passed=$$((passed + ran - missed)); failed=$$((failed + missed)); \
	done; \
	found="$$passed tests passed"; [ "$$failed" = 0 ] || found="$$found, $$failed failed"; \
	printf 'stage: %s\nsummary:\n  holds: %s\n  found: "%s"\n' $(basename $(notdir $(1))) $$holds "$$found" > $(1)
endef

# Rows whose evidence is tests, which run every time.
CLOSED_FORMS_RECORD := $(OUT)/closed_forms/closed_forms.yaml
FREE_OBJECT_RECORD := $(OUT)/free_object/free_object.yaml
.PHONY: closed-forms closed-forms-page free-object free-object-page
closed-forms-page: | build-closed-forms
	$(call record_tests,$(CLOSED_FORMS_RECORD),verification/verification_test=*PatchTest*:*WideLayerTest*)
# time_step_free_object_test.cpp, rigid_motion_test.cpp, simulate_free_test.cpp; time_step_bodies_test.cpp, time_step_soft_body_test.cpp,
# time_step_mirrored_gels_test.cpp; time_step_mounts_test.cpp, grasp_test.cpp, grasp_onset_test.cpp; bonded_layer_soft_ball_slow_test.cpp
FREE_OBJECT_SUITES := CarriedPairs.* FlyingBox.* FreeBox.* TallBox.* RollingBall.* DroppedBall.* FlatFace.* RigidMotion.* FreeObject.* Bodies.* \
  *JammingPeg.* WedgedPeg.* SoftBody.* *MirroredGels.* MovingMount.* TwoFingers.* SlipperyFingers.* Grasp.* GraspOnset.*
FREE_OBJECT_TESTS := stages/gel/press/press_test=$(subst $(space),:,$(FREE_OBJECT_SUITES)) verification/verification_slow_test=SoftBall.*
free-object-page: | build-free-object
	$(call record_tests,$(FREE_OBJECT_RECORD),$(FREE_OBJECT_TESTS))

closed-forms: closed-forms-page ## studies: Patch test, compression, simple shear, momentum and energy against closed forms (a second)
	$(call holds,$(CLOSED_FORMS_RECORD))

free-object: ## studies: Bodies against closed forms: flight, sliding, tipping, rolling, a drop, stacks, pegs, grasps, a soft ball, mirrored gels (two minutes)
free-object: free-object-page
	$(call holds,$(FREE_OBJECT_RECORD))

# $(call verification_table,folder,results,flags). A case that missed, failed or was skipped runs again next time,
# because its record is removed.
define verification_table
	TACIPC_SHARED='$(SHARED)' $(BIN)/verify_table --out $(1) --threads $(THREADS) $(addprefix --result ,$(2)) $(3)
	while read -r folder; do rm -f "$$folder/verify.yaml"; done < $(1)/unfinished.txt
endef

# $(call none_missed,record,keys): fails unless all of these numbers are 0.
none_missed = @[ "$$($(BIN)/tacipc get $(1) $(2) | sort -u)" = 0 ] || { echo "$(1): cases missed" >&2; exit 1; }

# Existing results of the long rows, from whichever call: a record, or the reason why there is none.
long_rows_there = $$(for record in $(LONG_RECORDS) $(LONG_RECORDS:.yaml=.failed.yaml); do [ ! -e $$record ] || echo "--long $$record"; done)

# $(call copy_tables,name,record): copies tables and plots of a long row to which the page links; does nothing if it
# failed.
define copy_tables
	@mkdir -p $(DOCS)/verification
	@[ ! -e $(2) ] || { cp $(dir $(2))tables.md $(DOCS)/verification/$(1).md; find $(dir $(2)) -name '*.svg' -exec cp {} $(DOCS)/verification/ ';'; }
endef

# The documentation shows only the stress campaign of 300 cases of seed 1.
.PHONY: verification verification-cases verification-page verify-case
verification-page: $(addsuffix /verify.yaml,$(VERIFICATION_RESULTS)) | $(addsuffix -page,$(LONG_ROWS))
	$(call verification_table,$(VERIFICATION)/page,$(VERIFICATION_RESULTS),--rows configs/studies/verification/table/long_rows.yaml $(long_rows_there))
	$(if $(filter 1-300,$(SEED)-$(N)),$(call to_docs,$(VERIFICATION)/page/verification.md))
	$(call to_docs,$(VERIFICATION)/page/verification/*.svg,verification)
	@echo; echo "Look at $(VERIFICATION)/page/verification.md"

verification: ## studies: All cases, then closed-forms, free-object, refinement, stress, board3; writes OUT/docs/verification.md (a quarter of an hour)
verification: verification-page
	$(call none_missed,$(VERIFICATION)/page/verify_table.yaml,summary.missed summary.long_missed)

verification-cases: verification-page ## studies: The cases of verification only; the long rows of the page stay unchanged
	$(call none_missed,$(VERIFICATION)/page/verify_table.yaml,summary.missed)

ifdef CASE
override CASE := $(strip $(CASE))
$(call check_name,CASE)
ifeq ($(wildcard $(CASE)),)
  $(error CASE: $(CASE) does not exist)
endif
CASE_RESULT := $(OUT)/verify-case/$(basename $(notdir $(CASE)))
$(CASE_RESULT)/verify.yaml: $(CASE) | build-verification
	TACIPC_SHARED='$(SHARED)' $(call run,verify,--case $<)
verify-case: $(CASE_RESULT)/verify.yaml ## studies: One case of your own: CASE=file.yaml (docs/verification_cases.md)
	$(call verification_table,$(CASE_RESULT)/page,$(CASE_RESULT))
	$(call none_missed,$(CASE_RESULT)/page/verify_table.yaml,summary.missed)
else
verify-case:
	@echo "verify-case: say which case: make -f Makefile.data verify-case CASE=file.yaml" >&2; exit 2
endif
