# The demo: six embossed objects of different kinds, pressed 0.5 mm into the MC-Tac gel.

DEMO_COARSE := star gear dots rings weave
DEMO_FINE   := letter_a

$(foreach o,$(DEMO_FINE),$(eval $(call sample_rules,$(OUT)/demo/$(o),$(o),$(OUT)/objects/$(o),configs/objects/embossed.yaml,mctac,adaptive_0100um,configs/samples/press_0500um.yaml)))
$(foreach o,$(DEMO_COARSE),$(eval $(call sample_rules,$(OUT)/demo/$(o),$(o),$(OUT)/objects/$(o),configs/objects/embossed.yaml,mctac,adaptive_0250um,configs/samples/press_0500um.yaml)))
$(eval $(call report_rules,$(OUT)/demo,TacIPC demo,$(addprefix $(OUT)/demo/,$(DEMO_FINE) $(DEMO_COARSE))))

PATTERNS := $(basename $(notdir $(wildcard configs/emboss/*.yaml)))
$(foreach o,$(PATTERNS),$(eval $(call sample_rules,$(OUT)/demo-full/$(o),$(o),$(OUT)/objects/$(o),configs/objects/embossed.yaml,mctac,adaptive_0100um,configs/samples/press_0500um.yaml)))
$(eval $(call report_rules,$(OUT)/demo-full,TacIPC: nineteen embossed objects,$(addprefix $(OUT)/demo-full/,$(PATTERNS))))

.PHONY: demo demo-full
demo: $(OUT)/demo/report/report.yaml ## A small tactile dataset from six embossed objects (minutes)
	$(call look,$(OUT)/demo)

demo-full: $(OUT)/demo-full/report/report.yaml ## All nineteen embossed objects on the paper-size gel (about an hour)
	$(call look,$(OUT)/demo-full)
