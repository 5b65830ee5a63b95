//! Confounded groups: parameters that the runs see only in combinations.

use super::{BaseParameter, Derivation};
use crate::ids::{BaseId, KernelId, ParameterId};

/// Parameters that no fit of these runs tells apart.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Group {
    /// The parameters, ascending.
    pub parameters: Vec<ParameterId>,
    /// The base parameters they appear in: the combinations that are seen.
    pub base: Vec<BaseId>,
    /// The directions of the kernel among them.
    pub kernel: Vec<KernelId>,
}

impl Derivation {
    /// The confounded groups: directions of the kernel that share a parameter belong together. A parameter in no group is
    /// determined.
    pub fn groups(&self) -> Vec<Group> {
        let mut groups: Vec<Group> = Vec::new();
        for (i, vector) in self.kernel.iter_enumerated() {
            let own: Vec<ParameterId> = vector.iter().map(|(j, _)| *j).collect();
            let (touched, rest): (Vec<Group>, Vec<Group>) =
                groups.into_iter().partition(|g| own.iter().any(|j| g.parameters.contains(j)));
            let mut group = Group { parameters: own, base: Vec::new(), kernel: vec![i] };
            for other in touched {
                group.parameters.extend(other.parameters);
                group.kernel.extend(other.kernel);
            }
            groups = rest;
            groups.push(group);
        }
        for group in &mut groups {
            group.parameters.sort_unstable();
            group.parameters.dedup();
            group.kernel.sort_unstable();
            let sees = |(_, b): &(BaseId, &BaseParameter)| {
                b.definition.iter().any(|(j, _)| group.parameters.binary_search(j).is_ok())
            };
            group.base = self.base.iter_enumerated().filter(sees).map(|(i, _)| i).collect();
        }
        groups.sort_by_key(|g| g.parameters.first().copied());
        groups
    }

    /// True where a base parameter is called like the physical parameter that carries it.
    pub fn has_own_name(&self, base: BaseId) -> bool {
        self.base.get(base).is_some_and(|b| self.parameters[b.pivot].name == b.name)
    }

    /// True where a base parameter is one physical parameter and nothing else.
    pub fn is_alone(&self, base: BaseId) -> bool {
        self.base.get(base).is_some_and(|b| b.definition.len() == 1)
    }
}
