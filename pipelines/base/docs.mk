# Pages of docs/ that targets make. A target writes them and their plots to $(DOCS), which has the layout of docs/, so
# that no run changes a source. Only docs-update copies them into docs/.

DOCS := $(OUT)/docs
# Cost of a press, for estimate: as measured here by bench-press, otherwise as shipped.
COST_MODEL_SHIPPED := configs/studies/speed/cost_model.yaml
COST_MODEL_MEASURED := $(OUT)/bench/page/cost_model.yaml
COST_MODEL = $(or $(wildcard $(COST_MODEL_MEASURED)),$(COST_MODEL_SHIPPED))

# $(call to_docs,files,folder of docs): copies the files; does nothing without files
to_docs = @mkdir -p $(DOCS)/$(2) && cp $(1) $(DOCS)/$(2)
# $(call fill_docs,page,NAME=FRAGMENT …): writes the page of docs/ with new parts between its marks
fill_docs = bash pipelines/base/fill_page.sh docs/$(1) $(DOCS)/$(1) $(2)
docs_look = @echo; echo "Look at $(DOCS)/$(1) (docs-update copies it into docs/)"

.PHONY: docs-update
docs-update: ## development: Copy what goals wrote to OUT/docs, and the cost model that bench-press measured, into docs/ and configs/
	@[ -d $(DOCS) ] || { echo "docs-update: there is no $(DOCS); verification, paper, bench-press and other goals write it" >&2; exit 1; }
	@[ ! -d $(DOCS)/paper_results ] || rm -rf docs/paper_results # all pictures of one page
	@mkdir -p docs && cp -r $(DOCS)/. docs/
	@[ ! -e $(COST_MODEL_MEASURED) ] || cp $(COST_MODEL_MEASURED) $(COST_MODEL_SHIPPED)
	@find $(DOCS) -type f -printf 'docs/%P\n' | LC_ALL=C sort
