# The paper's benchmark, one page: make -f Makefile.data paper writes docs/paper-results.md, its pictures and, in OUT/paper, the page as HTML.
# paper-quick is the same at reduced size, in OUT/paper-quick alone.

PAPER_KIND ?= full
PAPER_full  := $(OUT)/paper
PAPER_quick := $(OUT)/paper-quick
PAPER := $(PAPER_$(PAPER_KIND))
PAPER_OBJECTS_full  := $(PATTERNS)#         files of configs/emboss
PAPER_OBJECTS_quick := star dots
PAPER_ABLATED_full  := star letter_r cobbles
PAPER_ABLATED_quick := star
PAPER_MESHES_full   := uniform_0500um uniform_0375um uniform_0250um adaptive_0400um adaptive_0250um adaptive_0100um
PAPER_MESHES_quick  := uniform_0500um adaptive_0400um
PAPER_FINE_full     := adaptive_0050um#     mesh of the reference
PAPER_FINE_quick    := adaptive_0250um
PAPER_OURS_full     := adaptive_0100um#     mesh of TacIPC
PAPER_OURS_quick    := adaptive_0400um
PAPER_LIGHT_full    := full_transport#       of the reference
PAPER_LIGHT_quick   := full_transport_quick
PAPER_TABLES_full   := paper#               beginning of the names of the tables' configurations
PAPER_TABLES_quick  := paper_quick
$(foreach v,OBJECTS ABLATED MESHES FINE OURS LIGHT TABLES,$(eval PAPER_$(v) := $(strip $(PAPER_$(v)_$(PAPER_KIND)))))

# $(call changed_config,target,configuration,keys): with some of its values changed (pipelines/set_keys.sh), rewritten only when they are.
define changed_config
$(1): $(2) pipelines/set_keys.sh FORCE
	@mkdir -p $$(@D); bash pipelines/set_keys.sh $(2) $(foreach k,$(3),'$(k)') > $$@.new; cmp -s $$@.new $$@ && rm $$@.new || mv $$@.new $$@
endef

include pipelines/paper_coins.mk

PAPER_FRAGMENTS := $(PAPER)/objects-table/image_table.yaml $(PAPER)/objects-depth/image_table.yaml $(PAPER)/objects-near/table/image_table.yaml $(PAPER)/ablation/table/mesh_ablation.yaml \
  $(PAPER)/ablation/images/image_table.yaml $(PAPER)/cost/cost_table.yaml


# Each part in a make of its own: some read files first that others make.
.PHONY: paper paper-quick paper-parts paper-page
paper_part = $(call make_again,--no-print-directory PAPER_KIND=$(PAPER_KIND) $(1))
paper-parts: | build
	@status=0; \
	$(call paper_part,-k paper-coins) || status=$$?; \
	if [ -e '$(SHARED)/data/gelsight_sim2real' ]; then $(call paper_part,paper-real) || status=$$?; else echo 'paper: there is no data/gelsight_sim2real below SHARED; Table I (a) is left out'; fi; \
	$(call paper_part,$(if $(filter quick,$(PAPER_KIND)),paper-quick-markers,paper-markers)) || status=$$?; \
	exit $$status
paper-coins: $(PAPER_FRAGMENTS)
.PHONY: paper-coins

paper_fragments := real=$(OUT)/paper/real/table.md objects=$(PAPER)/objects-table/table.md depth=$(PAPER)/objects-depth/table.md near=$(PAPER)/objects-near/table/table.md board3=$(PAPER)/markers/board3.md \
  fots=$(PAPER)/markers/fots.md meshes=$(PAPER)/ablation/table/table.md mesh_images=$(PAPER)/ablation/images/table.md cost=$(PAPER)/cost/total.md
paper-page:
	rm -rf $(PAPER)/paper_results
	mkdir -p $(PAPER)/paper_results $(PAPER)/cost
	for part in $(OUT)/paper/real $(addprefix $(PAPER)/,objects-table markers ablation/table ablation/images); do cp $$part/paper_results/* $(PAPER)/paper_results/ 2>/dev/null || true; done
	@# Everything that was run for this page, whichever call ran it.
	find $(wildcard $(addprefix $(OUT)/,emboss objects gels sim2real board3 fots paper/real paper/marker_runs) $(PAPER)) -name '*.timings.yaml' -print0 | sort -zu | xargs -0 cat | awk -v on="$$(lscpu | sed -n 's/^Model name: *//p')" '/^processor_s: / { sum += $$2 } END { printf "\nAll runs in the folders of this page together: %.1f processor hours. The page was made on: %s.\n", sum / 3600, on }' \
	  | cat $(wildcard $(PAPER)/cost/table.md) - > $(PAPER)/cost/total.md
	bash pipelines/paper_page.sh docs/paper-results.md $(PAPER) $(paper_fragments)
	$(if $(filter full,$(PAPER_KIND)),rm -rf docs/paper_results && cp -r $(PAPER)/paper_results docs/ && cp $(PAPER)/paper-results.md docs/)
	@echo; echo "Look at $(PAPER)/paper-results.html"

# What fails leaves its place on the page empty, and the goal fails at its end.
paper_whole = @status=0; $(call paper_part,paper-parts PAPER_KIND=$(1)) || status=$$?; $(call paper_part,paper-page PAPER_KIND=$(1)) && exit $$status
paper: ## The paper's benchmark: image tables, markers, ablation, cost; writes docs/paper-results.md (hours; parts need SHARED)
	$(call paper_whole,full)
paper-quick: ## The same at reduced size, in OUT/paper-quick (minutes)
	$(call paper_whole,quick)
