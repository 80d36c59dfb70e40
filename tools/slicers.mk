# Real slicers for tests/test_slicers.py, from Debian: `make slicers`. Run again, it does only what is missing.

CURA_DEFINITIONS := .slicers/cura/definitions/fdmprinter.def.json

.PHONY: slicers
slicers:
	@set -eu; \
	missing=; \
	command -v prusa-slicer >/dev/null || missing="$$missing prusa-slicer"; \
	command -v CuraEngine >/dev/null || missing="$$missing cura-engine"; \
	if [ -z "$$missing" ] && [ -f $(CURA_DEFINITIONS) ]; then exit 0; fi; \
	command -v apt-get >/dev/null || { \
		echo "slicers: there is no apt-get here; install prusa-slicer and cura-engine by hand" >&2; exit 1; }; \
	if [ -n "$$missing" ]; then \
		sudo=; \
		if [ "$$(id -u)" -ne 0 ]; then sudo=$$(command -v sudo || true); fi; \
		$$sudo env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends $$missing; \
	fi; \
	if [ ! -f $(CURA_DEFINITIONS) ]; then $(MAKE) --no-print-directory $(CURA_DEFINITIONS); fi
