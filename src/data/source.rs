//! What a command or a call begins with: a model by its name or its file, a project by its file or its folder.

use super::positions::Positions;
use super::project::{PROJECT, Project, ProjectError};
use super::text::{TextError, read_text};
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use thiserror::Error;
use trunnion_codegen::catalogue;
use trunnion_codegen::problems::{Described, Named};

/// A description's texts, and the project that names it.
#[derive(Clone, Debug, PartialEq)]
pub struct Source {
    /// The texts.
    pub described: Described,
    /// The project, if it is one's.
    pub project: Option<Project>,
}

/// Why there is none.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum SourceError {
    /// Neither in the catalogue nor a file.
    #[error("no model `{0}` in the catalogue and no such file\n  expected a model file or one of {names}", names = names())]
    NoSuchModel(String),
    /// A folder that is no project's.
    #[error("{0}: a folder without trunnion.toml\n  expected a model file, or a folder that `trunnion new` has made")]
    NoProject(String),
    /// It cannot be read.
    #[error("{file}: {problem}\n  expected a model file or one of {names}", file = .0.display(), problem = .1, names = names())]
    Unreadable(PathBuf, ErrorKind),
    /// No text.
    #[error("{file}: {problem}", file = .0.display(), problem = .1)]
    Text(PathBuf, TextError),
    /// Not a project's.
    #[error("{file}: {problem}", file = .0.display(), problem = .1)]
    Project(PathBuf, ProjectError),
}

impl SourceError {
    /// The file, and the line in it, counted from 1, where it is wrong.
    pub fn place(&self) -> (Option<&Path>, Option<usize>) {
        match self {
            Self::NoSuchModel(_) | Self::NoProject(_) => (None, None),
            Self::Unreadable(file, _) | Self::Text(file, _) => (Some(file), None),
            Self::Project(file, problem) => (Some(file), Some(problem.line())),
        }
    }
}

impl Source {
    /// By a name of the catalogue, a model file, a project file, or a folder with one.
    ///
    /// # Errors
    /// [`SourceError`]
    pub fn named(name: &str) -> Result<Self, SourceError> {
        if let Some(text) = catalogue::source(name) {
            return Ok(plain(name.to_owned(), text.to_owned()));
        }
        let path = file(Path::new(name))?;
        let text = text(&path)?;
        if Project::is_one(&text) { of_project(&path, text) } else { Ok(plain(path.display().to_string(), text)) }
    }

    /// Of a project file, or a folder with one.
    ///
    /// # Errors
    /// [`SourceError`]
    pub fn of_project(path: &Path) -> Result<Self, SourceError> {
        let path = file(path)?;
        let text = text(&path)?;
        of_project(&path, text)
    }

    /// The files that are read.
    pub fn inputs(&self) -> Vec<PathBuf> {
        let named = [Some(&self.described.model), self.described.stated.as_ref()];
        named.into_iter().flatten().map(|text| PathBuf::from(&text.name)).collect()
    }

    /// The project's folder, if it is one's.
    pub fn folder(&self) -> Option<PathBuf> {
        let folder = Path::new(&self.described.stated.as_ref()?.name).parent()?;
        Some(if folder == Path::new("") { PathBuf::from(".") } else { folder.to_owned() })
    }

    /// Where its runs are probed, and the file that says so.
    pub fn positions(&self) -> Option<(PathBuf, &Positions)> {
        let file = PathBuf::from(&self.described.stated.as_ref()?.name);
        Some((file, self.project.as_ref()?.positions.as_ref()?))
    }

    /// The files of readings that it names, as it names them, by the run.
    pub fn readings(&self) -> Vec<(String, Vec<String>)> {
        let folder = self.folder().unwrap_or_default();
        let named = |file: &PathBuf| file.strip_prefix(&folder).unwrap_or(file).display().to_string();
        let runs = self.project.iter().flat_map(|project| &project.runs);
        runs.map(|run| (run.name.clone(), run.files.iter().map(named).collect())).collect()
    }
}

/// The project file of a folder; another file itself.
fn file(path: &Path) -> Result<PathBuf, SourceError> {
    match path {
        folder if folder.is_dir() && !folder.join(PROJECT).exists() => {
            Err(SourceError::NoProject(folder.display().to_string()))
        }
        folder if folder.is_dir() => Ok(folder.join(PROJECT)),
        file => Ok(file.to_owned()),
    }
}

fn plain(name: String, text: String) -> Source {
    Source { described: Described { model: Named { name, text }, stated: None }, project: None }
}

/// A project with the model that it names.
fn of_project(path: &Path, text: String) -> Result<Source, SourceError> {
    let folder = path.parent().unwrap_or(Path::new(""));
    let project = Project::read(&text, folder).map_err(|e| SourceError::Project(path.to_owned(), e))?;
    let model = match catalogue::source(&project.model) {
        Some(text) => Named { name: project.model.clone(), text: text.to_owned() },
        None => {
            let file = folder.join(&project.model);
            Named { text: self::text(&file)?, name: file.display().to_string() }
        }
    };
    let stated = Some(Named { name: path.display().to_string(), text });
    Ok(Source { described: Described { model, stated }, project: Some(project) })
}

fn text(file: &Path) -> Result<String, SourceError> {
    read_text(file).map_err(|e| match e {
        TextError::Unreadable(ErrorKind::NotFound) => SourceError::NoSuchModel(file.display().to_string()),
        TextError::Unreadable(kind) => SourceError::Unreadable(file.to_owned(), kind),
        other => SourceError::Text(file.to_owned(), other),
    })
}

fn names() -> String {
    catalogue::MODELS.iter().map(|(name, _)| *name).collect::<Vec<_>>().join(", ")
}
