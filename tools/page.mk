# The pages that the package brings, bundled from page/, and a browser to test them. What is there already is left alone.

NODE_PACKAGES = page/node_modules/.package-lock.json

.PHONY: lint-page
page: $(NODE_PACKAGES)
	@cd page && npm run --silent bundle

# Where there is no node, or its packages cannot be reached, the page is not linted.
lint-page:
	@command -v npm >/dev/null || { echo "lint: there is no npm here, so page/ is not linted" >&2; exit 0; }; \
	$(MAKE) --no-print-directory $(NODE_PACKAGES) || { echo "lint: npm ci failed, so page/ is not linted" >&2; exit 0; }; \
	cd page && npm run --silent lint

$(NODE_PACKAGES): page/package-lock.json
	@cd page && npm ci --silent
	@touch $@

# Debian's chromium, for the tests of the pages.
browsers:
	@command -v chromium >/dev/null && exit 0; \
	command -v apt-get >/dev/null || \
		{ echo "browsers: there is no apt-get here; install chromium by other means" >&2; exit 1; }; \
	sudo=; \
	[ "$$(id -u)" = 0 ] || sudo=$$(command -v sudo) || true; \
	$$sudo apt-get update -q; \
	$$sudo env DEBIAN_FRONTEND=noninteractive apt-get install -y -q --no-install-recommends chromium
