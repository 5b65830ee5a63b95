//! Positions, each of its own type: the entry of one list cannot be looked up in another.
//!
//! The lists are [`TiVec`](typed_index_collections::TiVec)s of these ids; as text an id is the number generated source uses.

macro_rules! ids {
    ($($(#[$doc:meta])* $name:ident)*) => {
        $(
            $(#[$doc])*
            #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
            pub struct $name(usize);

            impl core::fmt::Display for $name {
                fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
                    self.0.fmt(f)
                }
            }

            impl From<usize> for $name {
                fn from(position: usize) -> Self {
                    Self(position)
                }
            }

            impl From<$name> for usize {
                fn from(id: $name) -> Self {
                    id.0
                }
            }
        )*
    };
}

ids! {
    /// An axis: the workpiece side's from the base outwards, then the tool side's.
    AxisId
    /// A run, in the order of elimination.
    RunId
    /// A function assumed of a motion error.
    FunctionId
    /// A function of a basis, and its coefficient.
    TermId
    /// A physical parameter of a derivation.
    ParameterId
    /// A base parameter of a derivation.
    BaseId
    /// A direction of a derivation's kernel.
    KernelId
}
