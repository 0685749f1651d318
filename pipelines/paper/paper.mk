# The paper's benchmark as one page: make -f Makefile.data paper writes OUT/docs/paper-results.md, its pictures and, in
# OUT/paper, the page as HTML. paper-quick is the same at reduced size, only in OUT/paper-quick.
$(call uses,sample/demo)

PAPER_KIND ?= full
PAPER_full  := $(OUT)/paper
PAPER_quick := $(OUT)/paper-quick
PAPER := $(PAPER_$(PAPER_KIND))
PAPER_OBJECTS_full  := $(PATTERNS)#         files of configs/objects/patterns
PAPER_OBJECTS_quick := star
PAPER_ABLATED_full  := star letter_r cobbles
PAPER_ABLATED_quick := star
PAPER_MESHES_full   := uniform_0500um uniform_0375um uniform_0250um adaptive_0400um adaptive_0250um adaptive_0100um
PAPER_MESHES_quick  := uniform_0500um adaptive_0400um
PAPER_FINE_full     := adaptive_0050um#     mesh of the reference
PAPER_FINE_quick    := adaptive_0250um
PAPER_OURS_full     := adaptive_0100um#     mesh of TacIPC
PAPER_OURS_quick    := adaptive_0400um
PAPER_LIGHT_full    := full_transport#       light of the reference
PAPER_LIGHT_quick   := full_transport_quick
PAPER_TABLES_full   := tables#              folder of the tables' configurations
PAPER_TABLES_quick  := tables_quick
$(foreach v,OBJECTS ABLATED MESHES FINE OURS LIGHT TABLES,$(eval PAPER_$(v) := $(strip $(PAPER_$(v)_$(PAPER_KIND)))))

# Parts of the page that a run of this benchmark makes: fragments and pictures in $(PAPER)/parts and $(PAPER)/markers.
# The run empties these folders first, so that nothing from an earlier run appears as its own. They also list the
# folders of all contributing runs, from whichever call. $(call paper_fragment,name,record of its table,yes if it has
# pictures): the target paper-fragment-<name>
define paper_fragment
.PHONY: paper-fragment-$(1)
paper-fragment-$(1): $(2)
	@mkdir -p $(PAPER)/parts/paper_results
	@cp $(dir $(2))table.md $(PAPER)/parts/$(1).md
	$(if $(3),@cp $(dir $(2))paper_results/* $(PAPER)/parts/paper_results/)
endef
# $(call paper_folders,name,folders)
paper_folders = @mkdir -p $(PAPER)/parts; printf '%s\n' $(2) > $(PAPER)/parts/$(1).folders

# Each part runs in a make of its own, because some read files first that others make.
.PHONY: paper paper-quick paper-parts paper-page
paper_part = $(call make_again,--no-print-directory PAPER_KIND=$(PAPER_KIND) $(1))
paper-parts: | build
	@rm -rf $(PAPER)/parts $(PAPER)/markers; status=0; \
	$(call paper_part,-k paper-coins) || status=$$?; \
	if [ -e '$(SHARED)/data/gelsight_sim2real' ]; then $(call paper_part,paper-fragment-real) || status=$$?; \
	else echo 'paper: there is no data/gelsight_sim2real below SHARED; Table I (a) is omitted'; fi; \
	$(call paper_part,$(if $(filter quick,$(PAPER_KIND)),paper-quick-markers,paper-markers)) || status=$$?; \
	exit $$status

PAPER_PARTS := $(foreach n,real objects depth near meshes mesh_images,$(n)=$(PAPER)/parts/$(n).md) \
  $(foreach n,board3 fots,$(n)=$(PAPER)/markers/$(n).md) cost=$(PAPER)/cost/total.md
paper-page:
	rm -rf $(PAPER)/paper_results
	mkdir -p $(PAPER)/paper_results $(PAPER)/cost
	for part in parts markers; do [ ! -d $(PAPER)/$$part/paper_results ] || cp -r $(PAPER)/$$part/paper_results $(PAPER)/; done
	@# Everything that was run for this page, whichever call ran it.
	{ cat $(wildcard $(PAPER)/parts/cost.md) /dev/null; echo; bash pipelines/paper/processor_hours.sh $(BIN) $(PAPER)/parts/*.folders; } > $(PAPER)/cost/total.md
	bash pipelines/paper/paper_page.sh docs/paper-results.md $(PAPER) $(PAPER_PARTS)
	$(if $(filter full,$(PAPER_KIND)),@rm -rf $(DOCS)/paper_results && mkdir -p $(DOCS) && cp -r $(PAPER)/paper_results $(PAPER)/paper-results.md $(DOCS))
	@echo; echo "Look at $(PAPER)/paper-results.html$(if $(filter full,$(PAPER_KIND)), (docs-update copies the page into docs/))"

# A failed part leaves its position on the page empty, and the target fails at its end.
paper_whole = @status=0; $(call paper_part,paper-parts PAPER_KIND=$(1)) || status=$$?; $(call paper_part,paper-page PAPER_KIND=$(1)) && exit $$status
paper: ## studies: The paper's benchmark: image tables, markers, ablation, cost; writes OUT/docs/paper-results.md (hours; parts need SHARED)
	$(call paper_whole,full)
paper-quick: ## studies: The paper's benchmark at reduced size, in OUT/paper-quick (minutes)
	$(call paper_whole,quick)
