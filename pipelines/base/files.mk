# Functions for files that recipes write themselves.

comma := ,
space := $(subst ,, )
define newline


endef

# $(call fields,prefix,keys,key=value …): sets <prefix>_<key> for every key: to its values, or to nothing if it has
# none.
fields = $(foreach k,$(2),$(eval $(1)_$(k) := $(patsubst $(k)=%,%,$(filter $(k)=%,$(3)))))

# $(call check_choices,SENSOR:sensors MESH:gels …): checks that each variable names a file in that folder of configs/.
check_choices = $(foreach v,$(1),$(if $(wildcard configs/$(lastword $(subst :, ,$(v)))/$($(firstword $(subst :, ,$(v)))).yaml),,$(error \
  $(firstword $(subst :, ,$(v))): there is no configs/$(lastword $(subst :, ,$(v)))/$($(firstword $(subst :, ,$(v)))).yaml)))

# $(call check_writable,folder,its contents): reports a folder that another user made, before anything else happens.
check_writable = $(foreach f,$(1) $(2:%=$(1)/%),$(if $(shell [ ! -e '$(f)' ] || [ -w '$(f)' ] || echo no),$(error \
  $(1): belongs to $(shell stat -c %U '$(f)') and you cannot write to it ($(f)); give another OUT=, or ask for the right to write)))

.PHONY: FORCE# for targets that are looked at in every run

# Rewrites a file only if its content has changed.
replace_if_changed_by = @mkdir -p $(@D); $(1) > $@.new; cmp -s $@.new $@ && rm $@.new || mv $@.new $@
replace_if_changed = $(call replace_if_changed_by,printf '%s\n' '$(subst $(newline),' ',$(1))')

# $(call changed_config,target,configuration,keys): configuration with some changed values (`tacipc set`: KEY=VALUE,
# +KEY=VALUE, -KEY), rewritten only if they change.
define changed_config
$(1): $(2) FORCE | build
	@mkdir -p $$(@D); $(BIN)/tacipc set $(2) $(foreach k,$(3),'$(k)') > $$@.new; cmp -s $$@.new $$@ && rm $$@.new || mv $$@.new $$@
endef
