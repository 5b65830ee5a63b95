//! What is printed of a model, under the names it has in Rust.

use proc_macro2::{Ident, Literal, TokenStream};
use quote::{format_ident, quote};

use super::{CONSTANT, LOCAL, Support, ident};
use crate::emit::function::Function;
use crate::emit::model::{EstimatedFunction, estimated, run};
use crate::emit::names::Scope;
use crate::graph::Unbound;
use crate::identify::Derivation;
use crate::ids::RunId;
use crate::model::Model;

/// Where the items of a model belong.
#[derive(Clone, Debug)]
pub enum Owner {
    /// To the module they stand in: `tilting`, `TILTING`, `Joint`.
    Module,
    /// To a type of the user's: `Table::along_x`, `Table::ALONG_X`, `TableJoint`.
    Type(Ident),
}

/// Everything that is printed of a model, under the names it has in Rust.
pub(super) struct Printed<'a> {
    pub model: &'a Model,
    pub derivation: &'a Derivation,
    pub support: &'a Support,
    pub owner: &'a Owner,
    pub rows: Vec<Row>,
    pub functions: Vec<Estimated>,
    /// Field of each length of the set-up, and the length's own name.
    pub lengths: Vec<(Ident, String)>,
}

/// A run's row.
pub(super) struct Row {
    /// Its place in the model.
    pub run: RunId,
    pub function: Function,
    pub name: Ident,
    /// The function that gives many rows.
    pub block: Ident,
    /// The constant that says which base parameters it holds.
    pub positions: Ident,
}

/// An estimated function.
pub(super) struct Estimated {
    pub function: EstimatedFunction,
    pub name: Ident,
}

impl<'a> Printed<'a> {
    pub fn new(
        model: &'a Model,
        derivation: &'a Derivation,
        owner: &'a Owner,
        support: &'a Support,
    ) -> Result<Self, Unbound> {
        let mut functions = Scope::new(LOCAL, &["fit", "two_step"]);
        let mut constants = Scope::new(CONSTANT, &["NAMES", "STEPS"]);
        let mut fields = Scope::new::<&str>(LOCAL, &[]);
        let row = |at: RunId| {
            let function = run(model, derivation, at)?;
            let plain = CONSTANT.sanitised(&function.name).to_uppercase();
            let (name, positions) = (functions.claim(&function.name), constants.claim_as(&plain));
            let block = ident("rows");
            Ok(Row { run: at, name: ident(&name), block, positions: ident(&positions), function })
        };
        let mut rows: Vec<Row> = derivation.runs.keys().map(row).collect::<Result<_, _>>()?;
        let own = estimated(model, derivation)?.into_iter();
        let own = own.map(|function| Estimated { name: ident(&functions.claim(&function.basis.name)), function });
        let own = own.collect();
        // What people write has its name first.
        for row in &mut rows {
            row.block = ident(&functions.claim(&format!("rows_of_{}", row.name)));
        }
        let lengths = model.alphabet.constants().map(|name| (ident(&fields.claim(name)), name.to_owned()));
        Ok(Self { model, derivation, support, owner, rows, functions: own, lengths: lengths.collect() })
    }

    /// Number of base parameters.
    pub fn size(&self) -> Literal {
        Literal::usize_unsuffixed(self.derivation.base.len())
    }

    /// Name of a generated type: `Joint`, or `TableJoint` of the user's type `Table`.
    pub fn type_name(&self, what: &str) -> Ident {
        match self.owner {
            Owner::Module => ident(what),
            Owner::Type(name) => format_ident!("{name}{what}"),
        }
    }

    /// Path of a generated function or constant.
    pub fn path(&self, name: &Ident) -> TokenStream {
        match self.owner {
            Owner::Module => quote!(#name),
            Owner::Type(owner) => quote!(#owner::#name),
        }
    }

    /// `Lengths<T>`; without any there is nothing of type `T` in it.
    pub fn lengths_type(&self) -> TokenStream {
        let name = self.type_name("Lengths");
        if self.lengths.is_empty() { quote!(#name) } else { quote!(#name<T>) }
    }

    /// `self.lengths.r, self.lengths.h,`
    pub fn own_lengths(&self) -> TokenStream {
        let fields = self.lengths.iter().map(|(field, _)| field);
        quote!(#(self.lengths.#fields,)*)
    }
}
