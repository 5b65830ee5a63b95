//! A set of coefficients, by index, that a caller turns into names.

/// Some of `P` coefficients.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Subset<const P: usize>([bool; P]);

impl<const P: usize> Subset<P> {
    /// The coefficients for which `member` is true, in order of index.
    pub(super) fn from_mask(member: [bool; P]) -> Self {
        Self(member)
    }

    /// The members, each moved to its place in `to`.
    pub(super) fn placed<const Q: usize>(&self, to: &[usize]) -> Subset<Q> {
        let mut member = [false; Q];
        for (&to, &is_member) in to.iter().zip(&self.0) {
            if let Some(member) = member.get_mut(to) {
                *member = is_member;
            }
        }
        Subset(member)
    }

    /// Indices of the members, ascending.
    pub fn iter(&self) -> impl Iterator<Item = usize> + '_ {
        (0..P).zip(self.0).filter_map(|(i, member)| member.then_some(i))
    }

    /// Names of the members, given the names of all `P` coefficients in order.
    pub fn names(&self, all: &[&'static str; P]) -> impl Iterator<Item = &'static str> {
        self.0.into_iter().zip(*all).filter_map(|(member, name)| member.then_some(name))
    }

    /// Whether coefficient `index` is a member; false beyond the last.
    pub fn contains(&self, index: usize) -> bool {
        self.0.get(index).copied().unwrap_or(false)
    }

    /// Number of members.
    pub fn len(&self) -> usize {
        self.iter().count()
    }

    /// Whether there are no members.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}
