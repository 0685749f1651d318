# Twenty objects in the gels of the four sensors, and the page that shows them.
SHOWCASE := $(OUT)/datasets/showcase
.PHONY: showcase
showcase: | build ## start: Twenty objects pressed into the gels of the four sensors (minutes); writes OUT/docs/showcase.md
	$(MAKE) -f Makefile.data --no-print-directory dataset CONFIG=configs/datasets/showcase.yaml REBUILD=no
	$(MAKE) -f Makefile.data --no-print-directory dataset-report CONFIG=configs/datasets/showcase.yaml REBUILD=no
	@mkdir -p $(DOCS)
	bash pipelines/dataset/showcase.sh $(SHOWCASE) $(BIN)/tacipc $(DOCS)
	$(call docs_look,showcase.md)
