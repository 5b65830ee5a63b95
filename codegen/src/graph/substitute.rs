//! Passes over the parts of an expression: which there are, and putting others in their place.

use super::build::Graph;
use super::node::{Id, Node};

impl Graph {
    /// For each node up to the last of `outputs`, whether an output is made of it.
    pub(super) fn reachable(&self, outputs: &[Id]) -> Vec<bool> {
        let end = outputs.iter().map(|id| id.index() + 1).max().unwrap_or(0);
        let mut used = vec![false; end];
        for output in outputs {
            used[output.index()] = true;
        }
        for index in (0..end).rev() {
            if used[index] {
                for child in self.node(Id(index as u32)).children() {
                    used[child.index()] = true;
                }
            }
        }
        used
    }

    /// The symbols that `outputs` depend on, in the order in which they were made.
    #[must_use]
    pub fn symbols(&self, outputs: &[Id]) -> Vec<Id> {
        let used = self.reachable(outputs);
        let ids = used.iter().enumerate().filter(|&(_, &used)| used).map(|(index, _)| Id(index as u32));
        ids.filter(|&id| matches!(self.node(id), Node::Symbol(_))).collect()
    }

    /// Each output with every `from` replaced by its `to`, all at once: what is put in is not replaced again.
    pub fn substitute(&mut self, outputs: &[Id], replacements: &[(Id, Id)]) -> Vec<Id> {
        let used = self.reachable(outputs);
        let mut now: Vec<Id> = (0..used.len() as u32).map(Id).collect();
        for (index, _) in used.iter().enumerate().filter(|&(_, &used)| used) {
            let id = Id(index as u32);
            now[index] = match replacements.iter().find(|(from, _)| *from == id) {
                Some(&(_, to)) => to,
                None if self.node(id).children().all(|child| now[child.index()] == child) => id,
                None => self.rebuild(id, &now),
            };
        }
        outputs.iter().map(|output| now[output.index()]).collect()
    }

    fn rebuild(&mut self, id: Id, now: &[Id]) -> Id {
        match self.node(id).clone() {
            Node::Symbol(_) | Node::Rational(_) | Node::Pi | Node::Sqrt2 => id,
            Node::Sum(terms) => {
                let at = |id: Id| if id == Id::ONE { id } else { now[id.index()] };
                let terms: Vec<_> = terms.iter().map(|term| (term.coefficient, at(term.node))).collect();
                self.linear(&terms)
            }
            Node::Product(coefficient, factors) => {
                let factors: Vec<_> =
                    factors.iter().map(|factor| (now[factor.base.index()], factor.exponent)).collect();
                self.monomial(coefficient, &factors)
            }
            Node::Sqrt(u) => self.sqrt(now[u.index()]),
            Node::Sin(u) => self.sin(now[u.index()]),
            Node::Cos(u) => self.cos(now[u.index()]),
            Node::Atan2(y, x) => self.atan2(now[y.index()], now[x.index()]),
        }
    }
}
