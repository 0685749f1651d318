# Real objects, to test that the press is robust: every mesh of the shared data in the default gel, ten of them in the
# paper's. SHARED is a folder with data/tacipc_release and data/printed_indenters (not part of this repository).

TABLE := $(OUT)/objects-table

RELEASE_OBJECTS := $(filter-out %/pen.obj %/wood_block.obj,$(wildcard $(SHARED)/data/tacipc_release/objects/*.obj))
PRINTED_OBJECTS := $(wildcard $(SHARED)/data/printed_indenters/*.stl)
TABLE_FILES := $(RELEASE_OBJECTS) $(PRINTED_OBJECTS)
PAPER_GEL_OBJECTS := Bear_8028 Wave_8134 board3 coin_5002 dragon_01 sphere cone dots triangle parallel_lines

name_of = $(basename $(notdir $(1)))

ifneq ($(filter objects-table routes,$(MAKECMDGOALS)),)
table_missing := $(filter-out $(foreach f,$(TABLE_FILES),$(call name_of,$(f))),$(PAPER_GEL_OBJECTS))
ifneq ($(table_missing),)
  $(error SHARED: $(SHARED) has no $(table_missing) in data/tacipc_release/objects and data/printed_indenters)
endif
endif

# $(call table_rules,folder,object,mesh,press)
table_rules = $(call sample_rules,$(TABLE)/$(1)/$(2),name=$(2) object=$(TABLE)/objects/$(2) object_yaml=configs/objects/printed_indenter.yaml \
  sensor=mctac mesh=$(3) motion=configs/motions/press_0500um.yaml press=configs/press/$(4).yaml)

# $(call table_object,file): decimated as every object is, the relief side pressing.
define table_object
$(TABLE)/objects/$(call name_of,$(1))/decimate.yaml: $(1) configs/objects/printed_indenter.yaml configs/objects/decimate/default.yaml $(always) | build
	$$(call run,decimate,--mesh $(1) --object configs/objects/printed_indenter.yaml --config configs/objects/decimate/default.yaml)
$(call table_rules,own,$(call name_of,$(1)),adaptive_0250um,frictionless)
endef
$(foreach f,$(TABLE_FILES),$(eval $(call table_object,$(f))))

# The paper's own gel.
PAPER_GEL := $(SHARED)/data/tacipc_release/gel/gelslim-gel-l_0.1.msh
$(OUT)/gels/mctac-import_paper/tetmesh.yaml: $(PAPER_GEL) configs/gels/import_paper.yaml configs/sensors/mctac.yaml $(always) | build
	$(call run,tetmesh,--import $(PAPER_GEL) --sensor configs/sensors/mctac.yaml --config configs/gels/import_paper.yaml)
$(foreach o,$(PAPER_GEL_OBJECTS),$(eval $(call table_rules,paper,$(o),import_paper,paper)))

TABLE_SAMPLES := $(foreach f,$(TABLE_FILES),$(TABLE)/own/$(call name_of,$(f))) $(foreach o,$(PAPER_GEL_OBJECTS),$(TABLE)/paper/$(o))
$(eval $(call report_rules,$(TABLE),TacIPC: real objects,$(TABLE_SAMPLES)))

$(TABLE)/objects.md: $(addsuffix /press/press.yaml,$(TABLE_SAMPLES)) pipelines/sample/objects_table.sh
	bash pipelines/sample/objects_table.sh $(TABLE) $(BIN)/tacipc > $@.new
	mv $@.new $@

.PHONY: objects-table
objects-table: $(TABLE)/objects.md $(TABLE)/report/report.yaml ## studies: Real objects of SHARED into our gel and the paper's; writes objects.md (minutes)
	@cat $(TABLE)/objects.md
	$(call look,$(TABLE))
