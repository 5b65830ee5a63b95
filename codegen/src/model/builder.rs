//! Descriptions in Rust: the builder.
//!
//! ```
//! use trunnion_codegen::model::{Draft, DraftAxis, DraftBall, DraftBasis, DraftReading, DraftRun};
//!
//! let model = Draft::new("table", "A rotary table")
//!     .constant("R")
//!     .on_workpiece(DraftAxis::rotary("C", "z").located(["EX0C", "EY0C"]))
//!     .run(
//!         DraftRun::new("radial", "c", DraftReading::bar("R"))
//!             .at("C", "c")
//!             .workpiece_ball(DraftBall::origin().setup(["w_x", "w_y", "w_z"]))
//!             .tool_ball(DraftBall::at(["R", "0", "0"]).setup(["t_x", "t_y", "t_z"])),
//!     )
//!     .function("EXC", DraftBasis::Fourier(2))
//!     .build()
//!     .unwrap();
//! assert_eq!(model.runs.len(), 1);
//! ```

use super::AxisKind;
use super::draft::{Draft, DraftAxis, DraftBall, DraftBasis, DraftFunction, DraftReading, DraftRun, Number};
use crate::source::Text;

fn texts<I: IntoIterator<Item: Into<Text>>>(items: I) -> Vec<Text> {
    items.into_iter().map(Into::into).collect()
}

impl Draft {
    /// A machine without axes yet.
    pub fn new(name: impl Into<Text>, title: impl Into<Text>) -> Self {
        Self { name: name.into(), title: title.into(), ..Self::default() }
    }

    /// How its errors are called: `iso230`, as without this, or `paper`.
    pub fn notation(mut self, notation: impl Into<Text>) -> Self {
        self.notation = Some(notation.into());
        self
    }

    /// A length of the set-up.
    pub fn constant(mut self, name: impl Into<Text>) -> Self {
        self.constants.push(name.into());
        self
    }

    /// The usual value of a length of the set-up, mm: `R_mm`.
    pub fn length(mut self, name: impl Into<Text>, mm: f64) -> Self {
        self.lengths.push(Number { name: name.into(), value: mm });
        self
    }

    /// The next axis that carries the workpiece, from the base outwards.
    pub fn on_workpiece(mut self, axis: DraftAxis) -> Self {
        self.workpiece.push(axis.name.clone());
        self.axes.push(axis);
        self
    }

    /// The next axis that carries the tool, from the base outwards.
    pub fn on_tool(mut self, axis: DraftAxis) -> Self {
        self.tool.push(axis.name.clone());
        self.axes.push(axis);
        self
    }

    /// The model's own name for the error that ISO 230-1 calls `iso`.
    pub fn rename(mut self, iso: impl Into<Text>, name: impl Into<Text>) -> Self {
        self.names.push((iso.into(), name.into()));
        self
    }

    /// A condition taken as exact: `EYC_cos2` is `0`, `EXC` is `0 at c = 0`.
    pub fn assume(mut self, parameter: impl Into<Text>, is: impl Into<Text>) -> Self {
        self.assume.push((parameter.into(), is.into()));
        self
    }

    /// The largest size of an error, with its unit in the name: `EXC_um`.
    pub fn limit(mut self, name: impl Into<Text>, value: f64) -> Self {
        self.limits.push(Number { name: name.into(), value });
        self
    }

    /// The next run.
    pub fn run(mut self, run: DraftRun) -> Self {
        self.runs.push(run);
        self
    }

    /// What is assumed of a motion error.
    pub fn function(mut self, error: impl Into<Text>, basis: DraftBasis) -> Self {
        self.functions.push(DraftFunction { error: error.into(), basis });
        self
    }

    /// A motion error the runs are made to find.
    pub fn estimate(mut self, error: impl Into<Text>) -> Self {
        self.estimate.push(error.into());
        self
    }

    /// Parameters preferred as pivots, in this order.
    pub fn order<I: IntoIterator<Item: Into<Text>>>(mut self, parameters: I) -> Self {
        self.order = texts(parameters);
        self
    }
}

impl DraftAxis {
    /// An axis that turns about `x`, `-y`, ….
    pub fn rotary(name: impl Into<Text>, direction: impl Into<Text>) -> Self {
        let direction = vec![direction.into()];
        Self { name: name.into(), kind: AxisKind::Rotary, direction, location: Vec::new(), range: None }
    }

    /// An axis that slides along `x`, `-y`, ….
    pub fn linear(name: impl Into<Text>, direction: impl Into<Text>) -> Self {
        Self { kind: AxisKind::Linear, ..Self::rotary(name, direction) }
    }

    /// Another direction: three expressions of length 1.
    pub fn along<I: IntoIterator<Item: Into<Text>>>(mut self, direction: I) -> Self {
        self.direction = texts(direction);
        self
    }

    /// Its lowest and highest coordinate, degrees or mm.
    pub fn range(mut self, low: f64, high: f64) -> Self {
        self.range = Some([low, high]);
        self
    }

    /// Its location errors, `EY0A` or `EC(0X)Y`.
    pub fn located<I: IntoIterator<Item: Into<Text>>>(mut self, errors: I) -> Self {
        self.location = texts(errors);
        self
    }
}

impl DraftRun {
    /// A run along `sweep` without coordinates yet.
    pub fn new(name: impl Into<Text>, sweep: impl Into<Text>, reading: DraftReading) -> Self {
        Self { name: name.into(), sweep: sweep.into(), reading, ..Self::default() }
    }

    /// A name for a part of its expressions; one that is `sqrt(…)` of a polynomial is its positive root.
    pub fn define(mut self, name: impl Into<Text>, expression: impl Into<Text>) -> Self {
        self.define.push((name.into(), expression.into()));
        self
    }

    /// Coordinate of an axis: an expression of the sweep, or `rest`.
    pub fn at(mut self, axis: impl Into<Text>, coordinate: impl Into<Text>) -> Self {
        self.at.push((axis.into(), coordinate.into()));
        self
    }

    /// The ball on the workpiece.
    pub fn workpiece_ball(mut self, ball: DraftBall) -> Self {
        self.workpiece_ball = ball;
        self
    }

    /// The ball on the tool.
    pub fn tool_ball(mut self, ball: DraftBall) -> Self {
        self.tool_ball = ball;
        self
    }

    /// What moves its axes with the feed and not with the geometry: `backlash Y`, `lateral play EZY`, `lag Y`, `mismatch`.
    pub fn nuisance<I: IntoIterator<Item: Into<Text>>>(mut self, terms: I) -> Self {
        self.nuisance = texts(terms);
        self
    }
}

impl DraftReading {
    /// The length of a bar.
    pub fn bar(length: impl Into<Text>) -> Self {
        Self::Bar(length.into())
    }

    /// The displacement along `x`, `-y`, …, or `xyz`.
    pub fn displacement(direction: impl Into<Text>) -> Self {
        Self::Displacement(vec![direction.into()])
    }
}

impl DraftBall {
    /// At the origin of the frame it sits in.
    pub fn origin() -> Self {
        Self::default()
    }

    /// At three expressions, mm.
    pub fn at<I: IntoIterator<Item: Into<Text>>>(place: I) -> Self {
        Self { at: texts(place), setup: Vec::new() }
    }

    /// Names of its set-up errors along x, y, z.
    pub fn setup<I: IntoIterator<Item: Into<Text>>>(mut self, errors: I) -> Self {
        self.setup = texts(errors);
        self
    }
}

impl DraftBasis {
    /// Polynomials up to a degree that satisfy conditions such as `f(2*pi) = f(0)`.
    pub fn polynomial<I: IntoIterator<Item: Into<Text>>>(degree: u8, conditions: I) -> Self {
        Self::Polynomial(degree, texts(conditions))
    }
}
