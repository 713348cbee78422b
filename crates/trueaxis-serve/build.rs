//! Builds the page with Vite and lists its files, so that the server carries them in itself.
//!
//! `TRUEAXIS_PAGE=FOLDER` gives a ready page instead. Without the feature `page` there is none.

use std::env;
use std::fmt::Write as _;
use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::Command;

/// What changes the page.
const SOURCES: [&str; 6] =
    ["src", "index.html", "package.json", "package-lock.json", "tsconfig.json", "vite.config.ts"];

fn main() {
    println!("cargo::rerun-if-env-changed=TRUEAXIS_PAGE");
    println!("cargo::rerun-if-changed=build.rs");
    let out = PathBuf::from(env::var_os("OUT_DIR").unwrap_or_default());
    let page = match (env::var_os("CARGO_FEATURE_PAGE"), env::var_os("TRUEAXIS_PAGE")) {
        (None, _) => Ok(None),
        (Some(_), Some(ready)) => ready_page(Path::new(&ready)).map(Some),
        (Some(_), None) => built_page(&out).map(Some),
    };
    let listed = page.and_then(|page| list(page.as_deref()));
    match listed
        .and_then(|text| fs::write(out.join("page.rs"), text).map_err(|e| format!("page.rs: {e}")))
    {
        Ok(()) => {}
        Err(why) => {
            why.lines().for_each(|line| println!("cargo::error={line}"));
        }
    }
}

/// A page that was built before.
fn ready_page(folder: &Path) -> Result<PathBuf, String> {
    println!("cargo::rerun-if-changed={}", folder.display());
    match folder.join("index.html").is_file() {
        true => Ok(folder.to_owned()),
        false => Err(format!(
            "TRUEAXIS_PAGE={}: no index.html is there; name the folder that `vite build` made",
            folder.display()
        )),
    }
}

fn built_page(out: &Path) -> Result<PathBuf, String> {
    let manifest = PathBuf::from(env::var_os("CARGO_MANIFEST_DIR").unwrap_or_default());
    let web = manifest.join("../../web");
    for source in SOURCES {
        println!("cargo::rerun-if-changed={}", web.join(source).display());
    }
    // What the page says of the server's answers stands in the dictionaries of its reports.
    for language in ["de", "zh"] {
        let folder = manifest.join("../trueaxis-words/src").join(language);
        println!("cargo::rerun-if-changed={}", folder.display());
    }
    let page = out.join("page");
    // Two builds at a time (two target folders) would install into one folder.
    let lock = File::create(web.join(".installing")).and_then(|file| file.lock().map(|()| file));
    let lock = lock.map_err(|e| format!("{}: {e}", web.join(".installing").display()))?;
    if !is_installed(&web) {
        let npm = if cfg!(windows) { "npm.cmd" } else { "npm" };
        run(Command::new(npm).args(["ci", "--ignore-scripts", "--no-audit", "--no-fund"]), &web)?;
    }
    let vite = ["node_modules/vite/bin/vite.js", "build", "--logLevel", "warn", "--emptyOutDir"];
    run(Command::new("node").args(vite).arg("--outDir").arg(&page), &web)?;
    drop(lock);
    Ok(page)
}

/// Whether the libraries of the page are those of its lock file.
fn is_installed(web: &Path) -> bool {
    let changed = |path: PathBuf| fs::metadata(path).and_then(|m| m.modified()).ok();
    let installed = changed(web.join("node_modules/.package-lock.json"));
    installed.is_some() && installed >= changed(web.join("package-lock.json"))
}

fn run(command: &mut Command, web: &Path) -> Result<(), String> {
    let name = command.get_program().display().to_string();
    let instead =
        "or build without it (--no-default-features), or give a ready page by TRUEAXIS_PAGE";
    let output = command.current_dir(web).output().map_err(|e| {
        format!(
            "`{name}` cannot be run ({e}): install Node.js 20 or newer to build the page, {instead}"
        )
    })?;
    if output.status.success() {
        return Ok(());
    }
    let said = [output.stdout, output.stderr].map(|s| String::from_utf8_lossy(&s).into_owned());
    Err(format!(
        "the page cannot be built in web/: {name} failed; correct it, {instead}\n{}",
        said.concat()
    ))
}

/// `PAGE: [(path, type, bytes)]` as Rust.
fn list(page: Option<&Path>) -> Result<String, String> {
    let mut files = Vec::new();
    if let Some(page) = page {
        collect(page, page, &mut files).map_err(|e| format!("{}: {e}", page.display()))?;
    }
    files.sort();
    let mut text = String::from("pub const PAGE: &[(&str, &str, &[u8])] = &[\n");
    for (name, path) in files {
        let kind = kind(&name)?;
        let path = path.canonicalize().map_err(|e| format!("{name}: {e}"))?;
        // Writing to a String cannot fail.
        let _ = writeln!(text, "    ({name:?}, {kind:?}, include_bytes!({path:?})),");
    }
    Ok(text + "];\n")
}

fn collect(top: &Path, folder: &Path, files: &mut Vec<(String, PathBuf)>) -> std::io::Result<()> {
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        if path.is_dir() {
            collect(top, &path, files)?;
        } else if let Ok(name) = path.strip_prefix(top) {
            files.push((name.to_string_lossy().replace('\\', "/"), path.clone()));
        }
    }
    Ok(())
}

fn kind(name: &str) -> Result<&'static str, String> {
    Ok(match name.rsplit('.').next().unwrap_or("") {
        "html" => "text/html; charset=utf-8",
        "js" => "text/javascript; charset=utf-8",
        "css" => "text/css; charset=utf-8",
        "svg" => "image/svg+xml",
        "png" => "image/png",
        "json" => "application/json",
        _ => return Err(format!("{name}: what kind of file is that? say it in build.rs")),
    })
}
