//! The mutants: each is a part of a method with one mistake.

use fearless_simd::Simd;
use transpoint::basis::{self, Fit};
use transpoint::cells::CellKind;
use transpoint::equation_of_state::EquationOfState;
use transpoint::material::{Deviatoric, General, GeneralState, Material, Strain, Work};
use transpoint::math::Tensor;
use transpoint::quadrature::{PointVolumes, Quadrature, Samples};
use transpoint::reconstruction::{Cloud, MovingLeastSquares, PointField, Reconstruction};
use transpoint::shape::{AxisPosition, Linear, QuadraticBspline, Row, ShapeFunction};
use transpoint::transfer::{Apic, Transfer};

use crate::common::parts::{FLIP, MIXED};

/// A quadratic B-spline altered in one way.
#[derive(Clone, Copy)]
pub struct Spline<const MUTATION: u8>;

pub const NO_WALLS: u8 = 0;
pub const STEEP: u8 = 1;
pub const LOPSIDED: u8 = 2;

impl<const MUTATION: u8> ShapeFunction<f64> for Spline<MUTATION> {
    const WIDTH: usize = 3;
    const REACH: usize = 3;

    fn row(&self, at: AxisPosition<f64>) -> Row<f64> {
        let periodic = at.periodic || MUTATION == NO_WALLS;
        let mut row = QuadraticBspline.row(AxisPosition { periodic, ..at });
        if MUTATION == STEEP {
            row.gradient = row.gradient.map(|slope| 1.01 * slope);
        }
        if MUTATION == LOPSIDED {
            row.weight[0] += 1e-3;
            row.weight[2] -= 1e-3;
        }
        row
    }

    fn node_coordinate(&self, index: usize, n_cells: usize, periodic: bool) -> f64 {
        ShapeFunction::<f64>::node_coordinate(&QuadraticBspline, index, n_cells, periodic)
    }
}

/// "Linear" moving least squares that forgets its linear terms.
#[derive(Clone, Copy)]
pub struct DroppedTerms;

impl Reconstruction<f64, 2> for DroppedTerms {
    const REBUILDS_NODES: bool = true;

    fn support(&self) -> f64 {
        1.0
    }

    fn fit_center<S: Simd, P: PointField<f64, 2>>(
        &self,
        simd: S,
        cloud: &Cloud<'_, f64, 2>,
        cell: [usize; 2],
        field: P,
    ) -> Fit<P::Field> {
        MovingLeastSquares::<basis::Constant, f64>::new(1.0).fit_center(simd, cloud, cell, field)
    }

    fn fit_node<S: Simd, P: PointField<f64, 2>>(
        &self,
        simd: S,
        cloud: &Cloud<'_, f64, 2>,
        node: [f64; 2],
        field: P,
    ) -> Fit<P::Field> {
        MovingLeastSquares::<basis::Constant, f64>::new(1.0).fit_node(simd, cloud, node, field)
    }
}

/// APIC altered in one way.
#[derive(Clone, Copy)]
pub struct Affine<const MUTATION: u8>;

pub const FLIPPED: u8 = 0;
pub const TRANSPOSED: u8 = 1;
pub const UNSCALED: u8 = 2;

impl<const MUTATION: u8> Transfer<f64, 2> for Affine<MUTATION> {
    type Affine = Tensor<f64, 2>;
    const USES_INCREMENT: bool = false;
    const AFFINE: bool = true;

    fn flip_share(&self, _dt: f64) -> f64 {
        0.0
    }

    fn affine_entry(affine: &Self::Affine, row: usize, axis: usize) -> f64 {
        match MUTATION {
            FLIPPED => -affine.0[row][axis],
            TRANSPOSED => affine.0[axis][row],
            _ => affine.0[row][axis],
        }
    }

    fn affine_of(gradient: [[f64; 2]; 2]) -> Self::Affine {
        Tensor(gradient)
    }

    fn affine_from(columns: &[[f64; 4]; 2], second_moment: &[f64; 4]) -> Self::Affine {
        let moment = if MUTATION == UNSCALED { [2e-3; 4] } else { *second_moment };
        <Apic as Transfer<f64, 2>>::affine_from(columns, &moment)
    }
}

/// FLIP that takes up twice the difference between the points and the grid.
#[derive(Clone, Copy)]
pub struct Overshoot;

impl Transfer<f64, 2> for Overshoot {
    type Affine = ();
    const USES_INCREMENT: bool = true;
    const AFFINE: bool = false;

    fn flip_share(&self, dt: f64) -> f64 {
        2.0 * Transfer::<f64, 2>::flip_share(&FLIP, dt)
    }

    fn affine_entry(_affine: &(), _row: usize, _axis: usize) -> f64 {
        0.0
    }

    fn affine_of(_gradient: [[f64; 2]; 2]) {}

    fn affine_from(_columns: &[[f64; 4]; 2], _second_moment: &[f64; 4]) {}
}

/// Counts every point twice, or takes every cell for full.
#[derive(Clone, Copy)]
pub struct Wrong<const MUTATION: u8>;

pub const DOUBLE: u8 = 0;
pub const ALL_FULL: u8 = 1;

impl<const MUTATION: u8> Quadrature<f64, 2> for Wrong<MUTATION> {
    const USES_CENTERS: bool = true;
    const CLASSIFIES: bool = true;

    fn samples(&self, kind: CellKind) -> Samples {
        if MUTATION == ALL_FULL {
            Samples::Center
        } else {
            Quadrature::<f64, 2>::samples(&MIXED, kind)
        }
    }

    fn point_volumes<'a>(
        &self,
        _cloud: &'a Cloud<'a, f64, 2>,
        _slot: usize,
    ) -> PointVolumes<'a, f64, 2> {
        PointVolumes::Scaled(if MUTATION == DOUBLE { 2.0 } else { 1.0 })
    }
}

/// A fluid that speeds up what it should slow down.
#[derive(Clone, Copy)]
pub struct Antiviscous;

impl Material<f64, 2> for Antiviscous {
    type State = Tensor<f64, 2>;
    const PRESENT: bool = true;

    fn update(
        &self,
        law: &EquationOfState<f64>,
        state: &Self::State,
        strain: &Strain<f64, 2>,
    ) -> Self::State {
        Deviatoric::Newtonian { viscosity: -0.2 }.update(law, state, strain)
    }

    fn times(stress: &Self::State, gradient: [f64; 2]) -> [f64; 2] {
        <Deviatoric<f64> as Material<f64, 2>>::times(stress, gradient)
    }

    fn viscosity(&self, _sound_speed: f64) -> f64 {
        0.2
    }
}

/// A gas that forgets the kinetic energy which the transfer takes from its points.
#[derive(Clone, Copy)]
pub struct Heatless(pub General<f64>);

impl Material<f64, 2> for Heatless {
    type State = GeneralState<f64, 2>;
    const PRESENT: bool = true;

    fn initial(&self, energy: f64) -> Self::State {
        Material::<f64, 2>::initial(&self.0, energy)
    }

    fn update(
        &self,
        law: &EquationOfState<f64>,
        state: &Self::State,
        strain: &Strain<f64, 2>,
    ) -> Self::State {
        let work = strain.work.map(|work| Work { heat: 0.0, ..work });
        self.0.update(law, state, &Strain { work, ..*strain })
    }

    fn times(state: &Self::State, gradient: [f64; 2]) -> [f64; 2] {
        <General<f64> as Material<f64, 2>>::times(state, gradient)
    }

    fn energy(state: &Self::State) -> f64 {
        state.energy
    }

    fn viscous_pressure(state: &Self::State) -> f64 {
        state.viscous_pressure
    }

    fn wants_work(&self) -> bool {
        true
    }

    fn viscosity(&self, sound_speed: f64) -> f64 {
        Material::<f64, 2>::viscosity(&self.0, sound_speed)
    }
}

/// A hat whose gradients do not cancel.
#[derive(Clone, Copy)]
pub struct Tilted;

impl ShapeFunction<f64> for Tilted {
    const WIDTH: usize = 2;
    const REACH: usize = 2;

    fn row(&self, at: AxisPosition<f64>) -> Row<f64> {
        let mut row = Linear.row(at);
        row.gradient[1] += 1e-9;
        row
    }

    fn node_coordinate(&self, index: usize, n_cells: usize, periodic: bool) -> f64 {
        ShapeFunction::<f64>::node_coordinate(&Linear, index, n_cells, periodic)
    }
}
