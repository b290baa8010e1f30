//! Documents as pages in HTML, by a template.

use super::{Block, Document, Text};
use crate::report::prelude::*;
use minijinja::syntax::SyntaxConfig;
use minijinja::value::{Serde, Value};
use minijinja::{AutoEscape, Environment, UndefinedBehavior};

/// Variables of a page's template.
#[derive(Serialize)]
struct Page<'a> {
    title: &'a str,
    links: Vec<Text>,
    blocks: &'a [Block],
}

impl Document {
    /// Writes it as a page with links to others at its head.
    pub(in crate::report) fn write_page(&self, title: &str, links: Vec<Text>, path: &Path) -> Result<(), Error> {
        write_whole(path, self.page(title, links).map_err(|e| Error::file(path, e))?.as_bytes())
    }

    fn page(&self, title: &str, links: Vec<Text>) -> Result<String, minijinja::Error> {
        let mut environment = Environment::new();
        environment.set_undefined_behavior(UndefinedBehavior::Strict);
        environment.set_auto_escape_callback(|_| AutoEscape::Html);
        environment.set_syntax(SyntaxConfig::builder().trim_blocks(true).lstrip_blocks(true).build()?);
        environment.add_template("style.css", include_str!("../../../templates/style.css"))?;
        environment.add_template("page.html", include_str!("../../../templates/page.html"))?;
        let page = environment.get_template("page.html")?;
        let text = page.render(Value::from(Serde(Page { title, links, blocks: &self.blocks })))?;
        // A slash needs no escape within text and quoted values; runs and files have many.
        Ok(text.replace("&#x2f;", "/"))
    }
}
