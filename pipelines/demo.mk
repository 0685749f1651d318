# The demo: six embossed objects of different kinds, pressed 0.5 mm into the MC-Tac gel.

DEMO_COARSE := star gear dots rings weave
DEMO_FINE   := letter_a

# $(call demo_rules,folder,sample,object,mesh,motion,press configuration)
demo_rules = $(call sample_rules,$(1)/$(2),$(2),$(OUT)/objects/$(3),configs/objects/embossed.yaml,mctac,$(4),configs/samples/$(5).yaml,configs/press/$(6).yaml)

$(foreach o,$(DEMO_FINE),$(eval $(call demo_rules,$(OUT)/demo,$(o),$(o),adaptive_0100um,press_0500um,paper)))
$(foreach o,$(DEMO_COARSE),$(eval $(call demo_rules,$(OUT)/demo,$(o),$(o),adaptive_0250um,press_0500um,paper)))
$(eval $(call report_rules,$(OUT)/demo,TacIPC demo,$(addprefix $(OUT)/demo/,$(DEMO_FINE) $(DEMO_COARSE))))

PATTERNS := $(basename $(notdir $(wildcard configs/emboss/*.yaml)))
$(foreach o,$(PATTERNS),$(eval $(call demo_rules,$(OUT)/demo-full,$(o),$(o),adaptive_0100um,press_0500um,paper)))
$(eval $(call report_rules,$(OUT)/demo-full,TacIPC: nineteen embossed objects,$(addprefix $(OUT)/demo-full/,$(PATTERNS))))

.PHONY: demo demo-full
demo: $(OUT)/demo/report/report.yaml ## A small tactile dataset from six embossed objects (minutes)
	$(call look,$(OUT)/demo)

demo-full: $(OUT)/demo-full/report/report.yaml ## All nineteen embossed objects on the paper-size gel (about an hour)
	$(call look,$(OUT)/demo-full)
