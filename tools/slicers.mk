# Debian's PrusaSlicer and CuraEngine, for tests/test_slicers.py. What is there already is left alone, silently.

CURA := .slicers/cura
CURA_DEFINITIONS := $(CURA)/definitions/fdmprinter.def.json
NEED_APT = command -v apt-get >/dev/null || \
	{ echo "slicers: there is no apt-get here; install prusa-slicer and cura-engine by other means" >&2; exit 1; }

.PHONY: slicers slicer-programs
slicers: slicer-programs $(CURA_DEFINITIONS)

slicer-programs:
	@missing=; \
	command -v prusa-slicer >/dev/null || missing="$$missing prusa-slicer"; \
	command -v CuraEngine >/dev/null || missing="$$missing cura-engine"; \
	[ -n "$$missing" ] || exit 0; \
	$(NEED_APT); \
	sudo=; \
	[ "$$(id -u)" = 0 ] || sudo=$$(command -v sudo) || true; \
	$$sudo apt-get update -q; \
	$$sudo env DEBIAN_FRONTEND=noninteractive apt-get install -y -q --no-install-recommends $$missing

# Only the settings' definitions: installing the package `cura` would bring its whole desktop.
$(CURA_DEFINITIONS): | slicer-programs
	@$(NEED_APT); \
	set -e; \
	mkdir -p $(dir $(CURA)); \
	temporary=$$(mktemp -d $(dir $(CURA))XXXXXX); \
	trap 'rm -rf "$$temporary"' EXIT; \
	sudo=; \
	[ "$$(id -u)" = 0 ] || sudo=$$(command -v sudo) || true; \
	download="apt-get download -q -o APT::Sandbox::User=root cura"; \
	(cd "$$temporary" && { $$download || { $$sudo apt-get update -q && $$download; }; }) || \
		{ echo "slicers: apt-get found no package cura; CuraEngine's definitions are in it" >&2; exit 1; }; \
	dpkg-deb -x "$$temporary"/cura_*.deb "$$temporary"; \
	rm -rf $(CURA); \
	mkdir $(CURA); \
	mv "$$temporary"/usr/share/cura/resources/extruders "$$temporary"/usr/share/cura/resources/definitions $(CURA)
