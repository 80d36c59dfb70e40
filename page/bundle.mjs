// Builds the pages that the Python package brings: `npm ci && npm run bundle`, or `make page`.
//
// A folder of sources becomes a folder of the package. sources.sha256 lists, as sha256sum does, what was bundled and
// what came of it, so that a test notices a bundle that is older than its sources, with or without node.

import { createHash } from "node:crypto";
import { copyFileSync, existsSync, mkdirSync, readdirSync, readFileSync, writeFileSync } from "node:fs";
import { dirname, join, relative } from "node:path";
import { fileURLToPath } from "node:url";
import { build } from "esbuild";

const here = dirname(fileURLToPath(import.meta.url));
const root = dirname(here);
const shared = ["bundle.mjs", "package.json", "package-lock.json"];

/** Bundles: the module that begins it, the script that it becomes, further files to copy, folders of sources. */
const bundles = [
  {
    entry: "src/viewer/page.js",
    script: "infill/viewer/bundle/viewer.js",
    copied: ["src/viewer/page.css"],
    sources: ["src/viewer"],
  },
  {
    entry: "src/studio/studio.js",
    script: "infill/studio/bundle/studio.js",
    copied: ["src/studio/studio.css", "src/studio/index.html"],
    sources: ["src/viewer", "src/studio"],
  },
];

for (const bundle of bundles.filter(({ entry }) => existsSync(join(here, entry)))) {
  const script = join(root, bundle.script);
  const folder = dirname(script);
  mkdirSync(folder, { recursive: true });
  const { metafile } = await build({
    absWorkingDir: here,
    entryPoints: [bundle.entry],
    outfile: script,
    bundle: true,
    format: "iife",
    target: "es2022",
    minify: true,
    charset: "utf8",
    legalComments: "none",
    metafile: true,
    logLevel: "warning",
  });
  const made = [script];
  for (const file of bundle.copied.filter((name) => existsSync(join(here, name)))) {
    made.push(join(folder, file.split("/").at(-1)));
    copyFileSync(join(here, file), made.at(-1));
  }
  made.push(join(folder, "LICENSES.txt"));
  writeFileSync(made.at(-1), licences(Object.keys(metafile.inputs)));
  const sources = [...shared, ...bundle.sources.flatMap(filesOf)].map((name) => join(here, name));
  const lines = [...sources, ...made].map((path) => `${sha256(path)}  ${relative(root, path).replaceAll("\\", "/")}`);
  writeFileSync(
    join(folder, "sources.sha256"),
    `${lines.sort((a, b) => (a.slice(66) < b.slice(66) ? -1 : 1)).join("\n")}\n`,
  );
  console.log(bundle.script);
}

function filesOf(folder) {
  return readdirSync(join(here, folder), { recursive: true, withFileTypes: true })
    .filter((entry) => entry.isFile())
    .map((entry) => relative(here, join(entry.parentPath ?? entry.path, entry.name)));
}

function sha256(path) {
  return createHash("sha256").update(readFileSync(path)).digest("hex");
}

/** Return the licences of the packages that were bundled, whole. */
function licences(inputs) {
  const packages = new Set(inputs.map((path) => path.match(/node_modules\/((?:@[^/]+\/)?[^/]+)/)?.[1]).filter(Boolean));
  return [...packages]
    .sort()
    .map((name) => {
      const { version, license } = JSON.parse(readFileSync(join(here, "node_modules", name, "package.json"), "utf8"));
      const text = readFileSync(join(here, "node_modules", name, "LICENSE"), "utf8").trim();
      return `${name} ${version} (${license})\n\n${text}\n`;
    })
    .join("\n");
}
