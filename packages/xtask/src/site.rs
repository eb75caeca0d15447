//! `cargo xtask site`: the documents as a site in target/site. mdBook makes the pages by docs/book.toml and
//! docs/SUMMARY.md. It leaves links to files outside docs/ as they are: they get the repository's address here. Then
//! every link is followed, but those to other sites.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Component, Path, PathBuf};
use std::process::Command;

const VERSION: &str = "0.5.4";

pub fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// Makes the site, or says what is wrong with it.
pub fn make() -> Result<(), String> {
    wrong(missing_in_the_summary()?)?;
    let tools = root().join("target/mdbook");
    let version = ["--version", VERSION, "--no-default-features", "--features", "search", "--root"];
    // Nothing is done where that version is there already.
    done(Command::new(env!("CARGO")).args(["install", "--locked", "--quiet", "mdbook"]).args(version).arg(&tools))?;
    done(Command::new(tools.join("bin/mdbook")).arg("build").arg(root().join("docs")))?;
    let site = root().join("target/site");
    lead_out(&site)?;
    let (broken, links) = broken_links(&site)?;
    wrong(broken)?;
    println!("target/site/index.html: {links} links within the site lead somewhere");
    Ok(())
}

fn done(command: &mut Command) -> Result<(), String> {
    let name = command.get_program().display().to_string();
    match command.status() {
        Ok(status) if status.success() => Ok(()),
        Ok(status) => Err(format!("{name}: {status}")),
        Err(error) => Err(format!("{name}: {error}")),
    }
}

fn wrong(list: Vec<String>) -> Result<(), String> {
    if list.is_empty() { Ok(()) } else { Err(list.join("\n")) }
}

/// Pages of docs/ that the table of contents does not have exactly once.
fn missing_in_the_summary() -> Result<Vec<String>, String> {
    let docs = root().join("docs");
    let summary = read(&docs.join("SUMMARY.md"))?;
    let listed: Vec<&str> = summary.split("](").skip(1).filter_map(|rest| Some(rest.split_once(')')?.0)).collect();
    let mut list = Vec::new();
    for page in files(&docs, "md")? {
        let name = page.to_string_lossy();
        let times = listed.iter().filter(|listed| **listed == name).count();
        if times != 1 && name != "SUMMARY.md" {
            list.push(format!("docs/SUMMARY.md has {name} {times} times"));
        }
    }
    Ok(list)
}

fn read(file: &Path) -> Result<String, String> {
    std::fs::read_to_string(file).map_err(|error| format!("{}: {error}", file.display()))
}

/// The files of that ending below a folder, by their paths in it.
fn files(folder: &Path, ending: &str) -> Result<Vec<PathBuf>, String> {
    let unreadable = |error| format!("{}: {error}", folder.display());
    let mut list = Vec::new();
    for entry in std::fs::read_dir(folder).map_err(unreadable)? {
        let path = entry.map_err(unreadable)?.path();
        let name = Path::new(path.file_name().expect("an entry has a name"));
        if path.is_dir() {
            list.extend(files(&path, ending)?.iter().map(|below| name.join(below)));
        } else if path.extension().is_some_and(|found| found == ending) {
            list.push(name.into());
        }
    }
    list.sort();
    Ok(list)
}

/// The values of an attribute in a page.
fn values<'a>(html: &'a str, attribute: &str) -> Vec<&'a str> {
    html.split(&format!(" {attribute}=\"")).skip(1).filter_map(|rest| Some(rest.split_once('"')?.0)).collect()
}

/// A link's file, without what stands behind it, and its heading; nothing of links to other sites.
fn parts(link: &str) -> Option<(&str, &str)> {
    let is_outside =
        link.contains("://") || ["mailto:", "data:", "javascript:"].iter().any(|start| link.starts_with(start));
    let (file, heading) = link.split_once('#').unwrap_or((link, ""));
    (!is_outside).then_some((file.split('?').next().unwrap_or(file), heading))
}

/// Where a link of a page leads, in a repository that has the site as its folder docs.
fn target(page: &Path, file: &str) -> PathBuf {
    if file.is_empty() {
        return Path::new("docs").join(page);
    }
    let mut path = PathBuf::new();
    for part in Path::new("docs").join(page.with_file_name("")).join(file).components() {
        match part {
            Component::ParentDir => drop(path.pop()),
            part => path.push(part),
        }
    }
    path
}

/// Has links out of docs/ lead to the repository.
fn lead_out(site: &Path) -> Result<(), String> {
    let settings = read(&root().join("docs/book.toml"))?;
    let address = settings.lines().find_map(|line| line.strip_prefix("git-repository-url = \"")?.strip_suffix('"'));
    let address = address.ok_or("docs/book.toml has no git-repository-url")?;
    let mut broken = Vec::new();
    for page in files(site, "html")? {
        let html = read(&site.join(&page))?;
        let mut new = html.clone();
        for link in values(&html, "href") {
            let Some((file, heading)) = parts(link) else { continue };
            let path = target(&page, file);
            if path.starts_with("docs") {
                continue;
            }
            // mdBook has made .html of .md.
            let Some(path) =
                [path.clone(), path.with_extension("md")].into_iter().find(|path| root().join(path).exists())
            else {
                broken.push(format!("{}: {link} leads to no file of the repository", page.display()));
                continue;
            };
            let heading = if heading.is_empty() { String::new() } else { format!("#{heading}") };
            let there = format!("{address}/blob/HEAD/{}{heading}", path.display());
            new = new.replace(&format!(" href=\"{link}\""), &format!(" href=\"{there}\""));
        }
        std::fs::write(site.join(&page), new).map_err(|error| format!("{}: {error}", page.display()))?;
    }
    wrong(broken)
}

/// Links within the site to a file or heading that is not there, and how many links there are.
fn broken_links(site: &Path) -> Result<(Vec<String>, usize), String> {
    let pages = files(site, "html")?;
    let texts = pages.iter().map(|page| Ok((page.clone(), read(&site.join(page))?)));
    let texts = texts.collect::<Result<BTreeMap<PathBuf, String>, String>>()?;
    let headings: BTreeMap<&Path, BTreeSet<&str>> =
        texts.iter().map(|(page, html)| (page.as_path(), values(html, "id").into_iter().collect())).collect();
    let (mut list, mut links) = (Vec::new(), 0);
    for (page, html) in &texts {
        for link in values(html, "href").into_iter().chain(values(html, "src")) {
            let Some((file, heading)) = parts(link) else { continue };
            links += 1;
            let path = target(page, file);
            let is_there = path.strip_prefix("docs").is_ok_and(|path| {
                let known = heading.is_empty() || headings.get(path).is_some_and(|known| known.contains(heading));
                site.join(path).is_file() && known
            });
            if !is_there {
                list.push(format!("{}: {link} leads nowhere", page.display()));
            }
        }
    }
    Ok((list, links))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_page_is_in_the_table_of_contents_once() {
        assert_eq!(missing_in_the_summary(), Ok(Vec::new()));
    }

    #[test]
    fn links_that_lead_nowhere_are_found() {
        let site = root().join("target/tests-site");
        std::fs::create_dir_all(site.join("guides")).expect("a folder");
        let start = r#"<h1 id="start"></h1><a href="guides/c.html#install">, <a href="https://else.where/#there">"#;
        let page = r##"<h2 id="install"></h2><a href="../index.html#start"><a href="#install"><a href="c.html#no">
            <img src="../images/no.png"><a href="../no.html"><a href="../../README.html">"##;
        std::fs::write(site.join("index.html"), start).expect("a page");
        std::fs::write(site.join("guides/c.html"), page).expect("a page");
        let broken = ["c.html#no", "../no.html", "../../README.html", "../images/no.png"];
        let broken = broken.map(|link| format!("guides/c.html: {link} leads nowhere")).to_vec();
        assert_eq!(broken_links(&site), Ok((broken, 7)));
        // The README is the repository's, not the site's.
        lead_out(&site).expect("the README is there");
        let page = read(&site.join("guides/c.html")).expect("the page");
        assert!(page.contains("/blob/HEAD/README.md\"") && page.contains("../index.html#start"), "{page}");
        std::fs::write(site.join("index.html"), "<a href=\"../NO.html\">").expect("a page");
        assert_eq!(lead_out(&site), Err("index.html: ../NO.html leads to no file of the repository".into()));
    }
}
