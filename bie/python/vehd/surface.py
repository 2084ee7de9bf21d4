"""Surfaces, harmonics and layer operators."""

import re
from typing import Any, Optional

import numpy as np

from . import _core
from .arguments import real, reals, whole, word
from .scenes import Scene

# At the highest degree a grid of two million points.
_FINEST = 16
_SIDES = ("interior", "exterior", "principal_value")


class Operator:
    """A layer operator from coefficients to coefficients of degree p, as principal value: plain densities in, plain
    potentials out. Vector fields are [(p+1)², 3] or their three columns one after the other; densities may be complex.

        operator @ density, operator.matrix, operator.linear_operator()

    The potential is found at the nodes of degree p, p + 1 Gauss–Legendre latitudes times 2p + 2 longitudes, and projected
    onto degree p. The product of density and area element is not truncated.
    """

    def __init__(self, surface: "_core.Surface", layer: "_core.Layer", name: str, weighted: bool = False):
        self._layer = _core.LayerMatrix(surface, layer, weighted)
        self._surface = surface
        self._kind = layer
        self._weighted: Optional["Operator"] = self if weighted else None
        self._matrix: Optional[np.ndarray] = None
        self._of_vectors = layer in (_core.Layer.stokes_single, _core.Layer.stokes_double)
        self.name = name
        self.shape = (self._layer.size, self._layer.size)

    def __matmul__(self, density: np.ndarray) -> np.ndarray:
        if np.iscomplexobj(density):
            return (self @ np.real(density)) + 1j * (self @ np.imag(density))
        n = self.shape[0]
        density = reals("density", density, *([(n // 3, 3)] if self._of_vectors else []), (n,), (n, "k"))
        if self._of_vectors and density.shape == (self.shape[0] // 3, 3):
            return self._layer.apply(density.reshape(-1, order="F")).reshape(density.shape, order="F")
        return self._layer.apply(density)

    @property
    def matrix(self) -> np.ndarray:
        """[n, n], found once; read-only."""
        if self._matrix is None:
            matrix = self._layer.matrix()
            matrix.flags.writeable = False
            self._matrix = matrix
        return self._matrix

    @property
    def weighted(self) -> "Operator":
        """The operator that takes coefficients of J f, J the area element, in place of those of f: S and Stokes S take
        J f and return S[f], S′ takes J f and returns J S′[f], D′ takes f and returns J D′[f]; D and Stokes D are unchanged.

        On a strongly bent surface degree p resolves J f better than f.
        """
        if self._weighted is None:
            self._weighted = Operator(self._surface, self._kind, self.name + " weighted", True)
        return self._weighted

    def linear_operator(self) -> Any:
        """A scipy.sparse.linalg.LinearOperator, for Krylov solvers; needs scipy."""
        from scipy.sparse.linalg import LinearOperator

        return LinearOperator(self.shape, matvec=lambda x: self @ np.ravel(x), matmat=lambda x: self @ x, dtype=float)

    def __repr__(self) -> str:
        return f"<vehd.Operator {self.name}, {self.shape[0]} x {self.shape[1]}>"


class Surface:
    """A frozen closed surface x(θ, φ) of degree p with its geometry and layer operators.

    coefficients: of x, [(p+1)², 3], or a vesicle of a state, or another surface.
    upsampling: the grid is that of degree upsampling·p, so that products of fields are found without aliasing; 1 as in
        Example 1 of the paper.
    quadrature: nodes of the singular quadrature in θ per degree.

    Values have one row per point of the grid, latitude by latitude: `values.reshape(surface.shape)` is [n_theta, n_phi].
    H = −1 on the unit sphere, whose normal points outwards.

    InputError: x_θ × x_φ points inwards, or the surface encloses no volume.
    """

    def __init__(self, coefficients: Any, upsampling: int = 2, quadrature: float = 1.15):
        if isinstance(coefficients, Surface):
            coefficients = coefficients.coefficients
        position = getattr(coefficients, "position", coefficients)
        self._core = _core.Surface(reals("coefficients", position, ("(p+1)²", 3)),
                                   whole("upsampling", upsampling, 1, _FINEST),
                                   real("quadrature", quadrature, above=0.0, below=_FINEST))
        self._operators: dict = {}

    @classmethod
    def from_shape(cls, kind: str = "ellipsoid", degree: int = 16, upsampling: int = 2, quadrature: float = 1.15,
                   **keys: Any) -> "Surface":
        """A shape as in the table [shape] of a scene: from_shape("ellipsoid", axes=[1, 1, 2]),
        from_shape("radial", base=1, amplitude=0.2, exponent=-3, modes=[{"n": 3, "m": 2, "a": 1}]), …

        SceneError: the shape is not accepted; the message names no file or line.
        """
        tables = {"shape": {"kind": kind, **keys}, "membrane": {}, "numerics": {"degree": degree, "dt": 1.0,
                                                                              "end_time": 0.0}}
        try:
            scene = Scene.from_dict(tables)
        except _core.SceneError as error:  # the caller knows arguments, and neither lines nor tables
            raise _core.SceneError(re.sub(r'^dict:\d+: |(?<=") in \[(shape|numerics)\]', "", str(error))) from None
        return cls(scene.position(), upsampling, quadrature)

    @classmethod
    def sphere(cls, radius: float = 1.0, degree: int = 16, **keys: Any) -> "Surface":
        """A sphere about the origin."""
        return cls.from_shape("ellipsoid", degree, axes=[real("radius", radius, above=0.0)] * 3, **keys)

    @property
    def degree(self) -> int:
        """p."""
        return self._core.degree

    @property
    def coefficients(self) -> np.ndarray:
        """Coefficients of x, [(p+1)², 3]; a view, as are all arrays of the geometry."""
        return self._core.coefficients

    @property
    def shape(self) -> tuple:
        """(n_theta, n_phi) of the grid."""
        return self._core.shape

    @property
    def theta(self) -> np.ndarray:
        """Angles from +z of the grid, [n_theta]."""
        return self._core.theta

    @property
    def phi(self) -> np.ndarray:
        """Longitudes of the grid, [n_phi]."""
        return self._core.phi

    @property
    def position(self) -> np.ndarray:
        """x on the grid, [n_points, 3]."""
        return self._core.position

    @property
    def normal(self) -> np.ndarray:
        """Outward unit normal, [n_points, 3]."""
        return self._core.normal

    @property
    def mean_curvature(self) -> np.ndarray:
        """H, 1/length, [n_points]; −1 on the unit sphere."""
        return self._core.mean_curvature

    @property
    def gauss_curvature(self) -> np.ndarray:
        """K, 1/area, [n_points]."""
        return self._core.gauss_curvature

    @property
    def area_element(self) -> np.ndarray:
        """J = dA/dω against the unit sphere, [n_points]."""
        return self._core.area_element

    @property
    def weight(self) -> np.ndarray:
        """∫f dA = Σ f weight, [n_points]."""
        return self._core.weight

    @property
    def area(self) -> float:
        """∫dA."""
        return self._core.area

    @property
    def volume(self) -> float:
        """Enclosed volume."""
        return self._core.volume

    @property
    def centroid(self) -> np.ndarray:
        """∫x dA/∫dA, [3]."""
        return self._core.centroid

    @property
    def bending_energy_scaled(self) -> float:
        """∫H² dA; 4π of every sphere."""
        return self._core.bending_energy_scaled

    def integrate(self, values: np.ndarray) -> Any:
        """∫f dA of values [n_points] or of every column of [n_points, k]."""
        n = self.weight.size
        return self._core.integrate(reals("values", values, (n,), (n, "k")))

    def synthesize(self, coefficients: np.ndarray) -> np.ndarray:
        """Values on the grid from coefficients [(p+1)²] or [(p+1)², k]."""
        return self._core.synthesize(self._fields("coefficients", coefficients))

    def analyze(self, values: np.ndarray) -> np.ndarray:
        """Coefficients of degree up to p from values [n_points] or [n_points, k]."""
        n = self.weight.size
        return self._core.analyze(reals("values", values, (n,), (n, "k")))

    def gradient(self, scalar: np.ndarray) -> np.ndarray:
        """∇_γ f on the grid, [n_points, 3], of coefficients [(p+1)²]."""
        return self._core.gradient(self._scalar("scalar", scalar))

    def divergence(self, vector: np.ndarray) -> np.ndarray:
        """∇_γ·v on the grid, [n_points], of coefficients [(p+1)², 3], tangential or not."""
        return self._core.divergence(self._vector("vector", vector))

    def laplacian(self, fields: np.ndarray) -> np.ndarray:
        """Δ_γ f on the grid of coefficients [(p+1)²] or [(p+1)², k]."""
        return self._core.laplacian(self._fields("fields", fields))

    def bending_force(self, modulus: float = 1.0) -> np.ndarray:
        """f_b = −κ_B (Δ_γ H + 2H(H² − K)) n on the fluid per area, [n_points, 3]; −δ/δx of κ_B ∫H² dA, Eq. (2)."""
        return self._core.bending_force(real("modulus", modulus, least=0.0))

    def tension_force(self, tension: np.ndarray) -> np.ndarray:
        """f_λ = λ Δ_γ x + ∇_γ λ on the fluid per area, [n_points, 3], of coefficients of λ, force per length; Eq. (2)."""
        return self._core.tension_force(self._scalar("tension", tension))

    def _scalar(self, name: str, values: Any) -> np.ndarray:
        """Coefficients of one field."""
        return reals(name, values, (self.coefficients.shape[0],))

    def _vector(self, name: str, values: Any) -> np.ndarray:
        """Coefficients of a vector field."""
        return reals(name, values, (self.coefficients.shape[0], 3))

    def _fields(self, name: str, values: Any) -> np.ndarray:
        """Coefficients of any number of fields."""
        n = self.coefficients.shape[0]
        return reals(name, values, (n,), (n, "k"))

    def _operator(self, layer: str, name: str) -> Operator:
        if layer not in self._operators:
            self._operators[layer] = Operator(self._core, getattr(_core.Layer, layer), name)
        return self._operators[layer]

    @property
    def single_layer(self) -> Operator:
        """S, Eq. (8): ∫G f dA, G = 1/(4π|x−y|); 1/(2n+1) on the unit sphere."""
        return self._operator("single", "S")

    @property
    def double_layer(self) -> Operator:
        """D, Eq. (8): ∫∂G/∂n(y) f dA; −1/(2(2n+1)) on the unit sphere. Inside D − ½, outside D + ½."""
        return self._operator("double_layer", "D")

    @property
    def adjoint(self) -> Operator:
        """S′, Eq. (10): ∂/∂n(x) of S; −1/(2(2n+1)) on the unit sphere. Inside S′ + ½, outside S′ − ½."""
        return self._operator("adjoint", "S'")

    @property
    def hypersingular(self) -> Operator:
        """D′, Eq. (24): ∂/∂n(x) of D; −n(n+1)/(2n+1) on the unit sphere."""
        return self._operator("hypersingular", "D'")

    @property
    def stokes_single(self) -> Operator:
        """Stokes single layer, Eq. (6), at viscosity 1: velocity of a force per area, [3(p+1)², 3(p+1)²]."""
        return self._operator("stokes_single", "Stokes S")

    @property
    def stokes_double(self) -> Operator:
        """Stokes double layer, velocity of a velocity, [3(p+1)², 3(p+1)²]."""
        return self._operator("stokes_double", "Stokes D")

    def evaluate(self, points: np.ndarray, *, single: Optional[np.ndarray] = None,
                 double: Optional[np.ndarray] = None, stokes_single: Optional[np.ndarray] = None,
                 stokes_double: Optional[np.ndarray] = None, weighted: bool = False, gradients: bool = False,
                 side: str = "principal_value", tolerance: float = 1e-9) -> "_core.OffSurfaceValues":
        """Layers of given densities, coefficients, at any points [n, 3], near and far.

        weighted: single and stokes_single are coefficients of J f, J the area element, in place of f.
        side: of points on the surface itself: "interior", "exterior" or "principal_value".
        tolerance: of the quadrature, relative to the largest density.
        Returns single, double [n], stokes_single, stokes_double [n, 3], with gradients single_gradient, double_gradient
        [n, 3], each with its estimated error `single_error` … [n], which is that of the quadrature alone, since no density
        is truncated; inside, distance, resolved [n].

        ConvergenceError: the nearest point of the surface is not found.
        """
        densities = [None if density is None else check(name, density)
                     for name, density, check in (("single", single, self._scalar), ("double", double, self._scalar),
                                                  ("stokes_single", stokes_single, self._vector),
                                                  ("stokes_double", stokes_double, self._vector))]
        return _core.evaluate_layers(self._core, reals("points", points, ("n", 3)), *densities, bool(weighted),
                                     bool(gradients),
                                     getattr(_core.Side, word("side", side, _SIDES)),
                                     real("tolerance", tolerance, above=0.0, below=1.0))

    def __repr__(self) -> str:
        return f"<vehd.Surface of degree {self.degree}, area {self.area:.6g}>"
