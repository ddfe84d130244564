// Bundles src/ into dist/: the report's page (report.js, report.css), the explorer's (explore.js, explore.css,
// worker.js), and sources.json by which a test sees that they are up to date. The engine (dist/engine.js and what
// belongs to it) is not touched here: engine/build_engine.py makes it at a release.
import {build} from "esbuild";
import {createHash} from "node:crypto";
import {readdirSync, readFileSync, writeFileSync} from "node:fs";

const script = {
  bundle: true,
  minify: true,
  format: "iife",
  target: ["chrome109", "firefox115", "safari16"],
  legalComments: "none",
  charset: "utf8"
};
const places = {
  report: "src/report/main.ts",
  explore: "src/explore/main.ts",
  worker: "src/explore/worker.ts"
};
await build({...script, entryPoints: places, outdir: "dist"});
await build({
  entryPoints: {report: "src/report/page.css", explore: "src/explore/explore.css"},
  outdir: "dist",
  bundle: true,
  minify: true,
  charset: "utf8"
});

// The closing tag of a script must not occur inside one.
const scripts = Object.keys(places).map((name) => `${name}.js`);
for (const file of scripts)
  if (/<\/script|<!--/i.test(readFileSync(`dist/${file}`, "utf8")))
    throw new Error(`dist/${file} holds a text that would end its script element`);

const below = (folder) => readdirSync(folder, {recursive: true, withFileTypes: true})
                              .filter((e) => e.isFile())
                              .map((e) => `${e.parentPath ?? e.path}/${e.name}`)
                              .sort();
const sources = ["package.json", "package-lock.json", "tsconfig.json", "build.mjs", ...below("src")];
const made = [...scripts, "report.css", "explore.css"].map((file) => `dist/${file}`);
const sha256 = (file) => createHash("sha256").update(readFileSync(file)).digest("hex");
const hashes = Object.fromEntries([...sources, ...made].map((file) => [file, sha256(file)]));
writeFileSync("dist/sources.json", JSON.stringify(hashes, null, 2) + "\n");
for (const file of scripts) console.log(`dist/${file} ${(readFileSync(`dist/${file}`).length / 1e6).toFixed(2)} MB`);
