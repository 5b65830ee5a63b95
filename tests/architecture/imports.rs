//! Which file names an item of which other.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use syn::punctuated::Punctuated;
use syn::visit::{self, Visit};
use syn::{Attribute, Expr, Item, ItemUse, Token, UseTree, Visibility};

/// A module; one written inside another's file shares that file.
struct Module {
    file: PathBuf,
    parent: Option<usize>,
    children: BTreeMap<String, usize>,
    /// Names that are defined here.
    items: BTreeSet<String>,
    /// Names that are imported, with what they stand for.
    imports: Vec<(String, Vec<String>)>,
    /// Modules of which everything is imported.
    globs: Vec<Vec<String>>,
    content: Vec<Item>,
}

/// The modules of several crates.
pub struct Crates {
    roots: BTreeMap<String, usize>,
    modules: Vec<Module>,
}

impl Crates {
    /// Reads crates, each by its name and root file, through all their `mod`s.
    pub fn read(crates: &[(&str, PathBuf)]) -> Self {
        let mut all = Self { roots: BTreeMap::new(), modules: Vec::new() };
        for (name, root) in crates {
            let folder = root.parent().unwrap_or(Path::new(""));
            let content = parsed(root);
            let id = all.module(root, folder, None, content);
            all.roots.insert((*name).to_owned(), id);
        }
        all
    }

    /// Adds a module and those inside it, whose files are in `folder`.
    fn module(&mut self, file: &Path, folder: &Path, parent: Option<usize>, content: Vec<Item>) -> usize {
        let id = self.modules.len();
        self.modules.push(Module {
            file: file.to_owned(),
            parent,
            children: BTreeMap::new(),
            items: BTreeSet::new(),
            imports: Vec::new(),
            globs: Vec::new(),
            content: Vec::new(),
        });
        let mut kept = Vec::new();
        for item in content.into_iter().filter(|item| !only_tests(attributes(item))) {
            if let Item::Mod(inner) = item {
                let name = inner.ident.to_string();
                let own = folder.join(&name);
                let child = match inner.content {
                    Some((_, content)) => self.module(file, &own, Some(id), content),
                    None => {
                        let flat = folder.join(format!("{name}.rs"));
                        let file = if flat.is_file() { flat } else { own.join("mod.rs") };
                        let content = parsed(&file);
                        self.module(&file, &own, Some(id), content)
                    }
                };
                self.modules[id].children.insert(name, child);
                continue;
            }
            if let Item::Use(import) = &item {
                self.import(id, &import.tree, &mut Vec::new());
            } else {
                self.modules[id].items.extend(name(&item));
            }
            kept.push(item);
        }
        self.modules[id].content = kept;
        id
    }

    fn import(&mut self, module: usize, tree: &UseTree, path: &mut Vec<String>) {
        let mut whole = |last: String, name: String| {
            let path = path.iter().cloned().chain((last != "self").then_some(last)).collect();
            self.modules[module].imports.push((name, path));
        };
        match tree {
            UseTree::Path(part) => {
                path.push(part.ident.to_string());
                self.import(module, &part.tree, path);
                path.pop();
            }
            UseTree::Name(part) if part.ident == "self" => {
                let name = path.last().cloned().unwrap_or_default();
                whole("self".to_owned(), name);
            }
            UseTree::Name(part) => whole(part.ident.to_string(), part.ident.to_string()),
            UseTree::Rename(part) => whole(part.ident.to_string(), part.rename.to_string()),
            UseTree::Glob(_) => self.modules[module].globs.push(path.clone()),
            UseTree::Group(group) => group.items.iter().for_each(|tree| self.import(module, tree, path)),
        }
    }

    /// The module in which the item is defined that `path` names inside `module`; `None` for a module or another crate.
    fn definition(&self, module: usize, path: &[String], depth: usize) -> Option<usize> {
        let (first, rest) = path.split_first()?;
        let within = |module: usize| self.definition(module, rest, depth);
        let here = &self.modules[module];
        // Two names that stand for each other lead nowhere.
        if depth > 20 {
            return None;
        }
        match first.as_str() {
            "crate" => return within(self.root_of(module)),
            "self" => return within(module),
            "super" => return within(here.parent?),
            _ => {}
        }
        if here.items.contains(first) {
            return Some(module);
        }
        if let Some(child) = here.children.get(first) {
            return within(*child);
        }
        if let Some((_, target)) = here.imports.iter().find(|(name, _)| name == first) {
            let whole: Vec<String> = target.iter().chain(rest).cloned().collect();
            // `use name::…` of another crate must not find itself.
            if target.first() != Some(first) {
                return self.definition(module, &whole, depth + 1);
            }
        }
        if let Some(root) = self.roots.get(first) {
            return within(*root);
        }
        here.globs.iter().find_map(|glob| {
            let whole: Vec<String> = glob.iter().chain(path).cloned().collect();
            (glob.first() != Some(first)).then(|| self.definition(module, &whole, depth + 1))?
        })
    }

    fn root_of(&self, module: usize) -> usize {
        self.modules[module].parent.map_or(module, |parent| self.root_of(parent))
    }

    /// The files that each file depends on.
    pub fn dependencies(&self) -> BTreeMap<PathBuf, Vec<PathBuf>> {
        let mut graph: BTreeMap<PathBuf, BTreeSet<PathBuf>> = BTreeMap::new();
        for (id, module) in self.modules.iter().enumerate() {
            let mut named = Named::default();
            module.content.iter().for_each(|item| named.visit_item(item));
            let definitions = named.0.iter().filter_map(|path| self.definition(id, path, 0));
            let files = definitions.map(|other| self.modules[other].file.clone()).filter(|file| *file != module.file);
            graph.entry(module.file.clone()).or_default().extend(files);
        }
        graph.into_iter().map(|(file, others)| (file, others.into_iter().collect())).collect()
    }
}

/// All paths that a module's source names, but for what it re-exports.
#[derive(Default)]
struct Named(BTreeSet<Vec<String>>);

impl Named {
    fn tree(&mut self, tree: &UseTree, path: &mut Vec<String>) {
        match tree {
            UseTree::Path(part) => {
                path.push(part.ident.to_string());
                self.tree(&part.tree, path);
                path.pop();
            }
            UseTree::Name(syn::UseName { ident }) | UseTree::Rename(syn::UseRename { ident, .. }) => {
                self.0.insert(path.iter().cloned().chain([ident.to_string()]).collect());
            }
            UseTree::Glob(_) => {}
            UseTree::Group(group) => group.items.iter().for_each(|tree| self.tree(tree, path)),
        }
    }
}

impl<'a> Visit<'a> for Named {
    fn visit_item_use(&mut self, import: &'a ItemUse) {
        if matches!(import.vis, Visibility::Inherited) {
            self.tree(&import.tree, &mut Vec::new());
        }
    }

    fn visit_path(&mut self, path: &'a syn::Path) {
        self.0.insert(path.segments.iter().map(|part| part.ident.to_string()).collect());
        visit::visit_path(self, path);
    }

    /// What looks like the arguments of a call is read as such.
    fn visit_macro(&mut self, call: &'a syn::Macro) {
        if let Ok(arguments) = call.parse_body_with(Punctuated::<Expr, Token![,]>::parse_terminated) {
            let mut inner = Self::default();
            arguments.iter().for_each(|argument| inner.visit_expr(argument));
            self.0.extend(inner.0);
        }
    }
}

fn parsed(file: &Path) -> Vec<Item> {
    let text = fs::read_to_string(file).unwrap_or_else(|e| panic!("{}: {e}", file.display()));
    syn::parse_file(&text).unwrap_or_else(|e| panic!("{}: {e}", file.display())).items
}

fn only_tests(attributes: &[Attribute]) -> bool {
    attributes.iter().any(|a| a.path().is_ident("cfg") && a.parse_args::<syn::Ident>().is_ok_and(|c| c == "test"))
}

fn attributes(item: &Item) -> &[Attribute] {
    match item {
        Item::Mod(item) => &item.attrs,
        Item::Use(item) => &item.attrs,
        Item::Fn(item) => &item.attrs,
        Item::Impl(item) => &item.attrs,
        _ => &[],
    }
}

/// The name under which an item is found; a method is found with its type.
fn name(item: &Item) -> Option<String> {
    Some(match item {
        Item::Const(item) => item.ident.to_string(),
        Item::Enum(item) => item.ident.to_string(),
        Item::Fn(item) => item.sig.ident.to_string(),
        Item::Static(item) => item.ident.to_string(),
        Item::Struct(item) => item.ident.to_string(),
        Item::Trait(item) => item.ident.to_string(),
        Item::Type(item) => item.ident.to_string(),
        Item::Macro(item) => item.ident.as_ref()?.to_string(),
        _ => return None,
    })
}
