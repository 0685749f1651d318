# The demo: embossed objects of different kinds pressed 0.5 mm into the MC-Tac gel. On a coarser gel, two of them are
# afterwards moved sideways and turned; two are pressed into the gels of the other sensors.

DEMO_COARSE := star gear dots rings weave
DEMO_FINE   := letter_a
DEMO_MOVED  := dots_shear star_twist
DEMO_SENSORS := gelsight_mini digit gelsight_lab
DEMO_ELSEWHERE := $(foreach s,$(DEMO_SENSORS),star_$(s) rings_$(s))

# $(call demo_rules,folder,sample,object,mesh,motion[,sensor])
demo_rules = $(call sample_rules,$(1)/$(2),name=$(2) object=$(OUT)/objects/$(3) object_yaml=configs/objects/embossed.yaml \
  sensor=$(or $(6),mctac) mesh=$(4) motion=configs/motions/$(5).yaml press=configs/press/default.yaml)

$(foreach o,$(DEMO_FINE),$(eval $(call demo_rules,$(OUT)/demo,$(o),$(o),adaptive_0100um,press_0500um)))
$(foreach o,$(DEMO_COARSE),$(eval $(call demo_rules,$(OUT)/demo,$(o),$(o),adaptive_0250um,press_0500um)))
$(foreach s,$(DEMO_SENSORS),$(foreach o,star rings,$(eval $(call demo_rules,$(OUT)/demo,$(o)_$(s),$(o),adaptive_0250um,press_0500um,$(s)))))
$(eval $(call demo_rules,$(OUT)/demo,dots_shear,dots,adaptive_0400um,shear_0500um))
$(eval $(call demo_rules,$(OUT)/demo,star_twist,star,adaptive_0400um,twist_10deg))
$(eval $(call report_rules,$(OUT)/demo,TacIPC demo,$(addprefix $(OUT)/demo/,$(DEMO_FINE) $(DEMO_COARSE) $(DEMO_MOVED) $(DEMO_ELSEWHERE))))

PATTERNS := $(basename $(notdir $(wildcard configs/objects/patterns/*.yaml)))
$(foreach o,$(PATTERNS),$(eval $(call demo_rules,$(OUT)/demo-full,$(o),$(o),adaptive_0100um,press_0500um)))
$(eval $(call report_rules,$(OUT)/demo-full,TacIPC: nineteen embossed objects,$(addprefix $(OUT)/demo-full/,$(PATTERNS))))

DEMO_PROGRAMS := tacipc emboss decimate tetmesh press render report
programs_for_demo      := $(DEMO_PROGRAMS)
programs_for_demo-full := $(DEMO_PROGRAMS)
.PHONY: demo demo-full
demo: $(OUT)/demo/report/report.yaml ## start: A small tactile dataset: embossed objects pressed, sheared and twisted (minutes)
	$(call look,$(OUT)/demo)

demo-full: $(OUT)/demo-full/report/report.yaml ## start: All nineteen embossed objects on the paper-size gel (about an hour)
	$(call look,$(OUT)/demo-full)
