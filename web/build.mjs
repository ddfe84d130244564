// Bundles src/ into dist/: the report's page (report.js, report.css), the explorer's (explore.js, explore.css and
// worker.js: the engine's own script, dist/engine.js, and the worker behind it), and sources.json by which a test sees
// that dist/ is up to date. The engine itself comes from engine/build_engine.py.
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
await build({...script, entryPoints: {report: "src/results/report/main.ts", explore: "src/doors/explore/main.ts"}, outdir: "dist"});
await build({
  entryPoints: {report: "src/results/report/page.css", explore: "src/doors/explore/explore.css"},
  outdir: "dist",
  bundle: true,
  minify: true,
  charset: "utf8"
});
const worker = await build({...script, entryPoints: ["src/doors/explore/worker.ts"], write: false});
const glue = readFileSync("dist/engine.js", "utf8");
writeFileSync("dist/worker.js", `${glue}\n${worker.outputFiles[0].text}`);

// The closing tag of a script must not occur inside one.
for (const file of ["report.js", "explore.js", "worker.js"])
  if (/<\/script|<!--/i.test(readFileSync(`dist/${file}`, "utf8")))
    throw new Error(`dist/${file} holds a text that would end its script element`);

const below = (folder) => readdirSync(folder, {recursive: true, withFileTypes: true})
                              .filter((e) => e.isFile())
                              .map((e) => `${e.parentPath ?? e.path}/${e.name}`)
                              .sort();
const sources = ["package.json", "package-lock.json", "tsconfig.json", "build.mjs", ...below("src")];
const made = below("dist").filter((file) => !file.endsWith("sources.json"));
const sha256 = (file) => createHash("sha256").update(readFileSync(file)).digest("hex");
const hashes = Object.fromEntries([...sources, ...made].map((file) => [file, sha256(file)]));
writeFileSync("dist/sources.json", JSON.stringify(hashes, null, 2) + "\n");
for (const file of ["report.js", "explore.js"])
  console.log(`dist/${file} ${(readFileSync(`dist/${file}`).length / 1e6).toFixed(2)} MB`);
