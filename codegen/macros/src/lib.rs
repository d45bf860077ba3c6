//! The `robot!` macro: a shim over `stiffarm-codegen`.
#![forbid(unsafe_code)]

use std::path::PathBuf;

use proc_macro::TokenStream;

/// Turns a Denavit-Hartenberg table into a module of closed-form kernels.
///
/// ```ignore
/// stiffarm::robot! {
///     /// KUKA KR 240-2 (Dumas et al. 2011, Table 3).
///     pub mod kr240;
///     convention: modified_dh;
///     joint | theta | d       | a       | alpha  | stiffness
///     a1    | q     | 0       | 0       | 0      | 3.8e6 N*m/rad
///     a2    | q     | 0       | 350 mm  | 90 deg | 6.6e6 N*m/rad
/// }
/// stiffarm::robot! { pub mod elbow from "elbow.toml"; }
/// ```
///
/// A URDF does as well, with the feature `urdf`: the chain between two links (the root and the only tip, where they are
/// not named), fixed joints folded, a joint that mimics another refused.
///
/// ```ignore
/// stiffarm::robot! { pub mod arm from "arm.urdf", base "base_link", tip "tool0"; }
/// ```
///
/// Attributes (documentation among them) and the visibility of the module are kept. A file's name is
/// relative to the folder of the invoking crate's Cargo.toml; the compiler watches the file. Every
/// mistake is an error at its cell, all of them at once, and a module of the same names stands in for the
/// refused one.
///
/// # Settings
///
/// Each ends with `;` and stands once, `frame`, `marker` and `payload` as often as there are some. Beside a file only
/// `carries`, `outputs`, `products` and `crate` can be set.
///
/// | setting | values | without it |
/// |---|---|---|
/// | `name` | `"text"` | the module's name |
/// | `convention` | `standard_dh`: a row is Rz(theta) Tz(d) Tx(a) Rx(alpha); `modified_dh`: Rx(alpha) Tx(a) Rz(theta) Tz(d) | an error |
/// | `gravity` | `[x, y, z]`, an acceleration in base axes | `[0, 0, -9.80665 m/s^2]` |
/// | `base` | `translation [x, y, z] rotation [rx, ry, rz]`, either or both, in numbers: frame 0 in the world in which poses are told | frame 0 is the world |
/// | `tool` | `translation [x, y, z] rotation [rx, ry, rz]`, either or both: the tool in the last frame, rotation as a rotation vector (axis × angle) | the last frame |
/// | `marker` | `name` or `name [x, y, z]`: a measured point in the tool frame | none |
/// | `frame` | `name on a3 translation [x, y, z] rotation [rx, ry, rz]`, either part or neither, in numbers: a frame in that of the row `a3` (or `3`), named like a module | none |
/// | `payload` | `gripper mass 1.2 kg, com [x, y, z], inertia [xx, xy, xz, yy, yz, zz]`, in numbers, the last two if wanted: a load, its centre in the tool frame and its moments of inertia about that in the tool's axes | none |
/// | `carries` | `gripper`: the payload that hangs on the tool for good, a part of the last link | none, or what the robot file says |
/// | `outputs` | `pose, jacobian, pose at elbow, …`: what is generated, of the tool and at frames and markers, and `all` of what of the tool's can be had together | every output of the tool, or what the robot file says |
/// | `products` | `separate`, or `fused`: products fused into sums, faster where the target has the instruction and the kernels' feature `fma` asks for it, and not the same bits everywhere | `separate` |
/// | `crate` | the path of the kernels' crate | `::stiffarm::kernels` |
///
/// # The table
///
/// A header of column names, then a row for each joint, base to tip. Cells are separated by `|`; a row may
/// be continued on further lines. Columns stand in any order, and those that are not needed are left out.
///
/// | column | cell | left out, or `-` |
/// |---|---|---|
/// | `joint` | a label: a word or a number | `joint 1`, … |
/// | `theta` | an angle; with `q` the joint is revolute | 0 |
/// | `d` | a length; with `q` the joint is prismatic | 0 |
/// | `a` | a length | 0 |
/// | `alpha` | an angle | 0 |
/// | `beta` | an angle about y behind alpha (Hayati), for axes that are nearly parallel | 0 |
/// | `stiffness` | N·m/rad, N/m of a prismatic joint; or `rigid` | rigid |
/// | `mass` | of the link that the joint moves | weightless |
/// | `com` | `[x, y, z]`, its centre of mass in the row's own frame | the frame's origin |
/// | `inertia` | `[xx, xy, xz, yy, yz, zz]`, its moments of inertia about that centre in the row's axes | a point mass |
/// | `gear`, `rotor_inertia` | turns of the motor per turn of the joint (rad/m of a prismatic joint), and the moment of inertia of what turns with it | 1, none |
/// | `coulomb`, `viscous` | friction at the joint: N·m, and N·m·s/rad (N, N·s/m of a prismatic joint) | none |
/// | `limits` | `[low, high]` of the joint | none |
/// | `beam` | `{ youngs_modulus: …, shear_modulus: …, section: …, density: …, shear_coefficient: … }`: the link as a beam between the origins of the previous frame and this one's; `section` is `tube(outer, inner)`, `box([y, z], [y, z])` (outer, inner) or `{ area: …, iy: …, iz: …, j: … }`; without `density` weightless, without `shear_coefficient` an Euler-Bernoulli beam | a rigid link |
/// | `source` | `"text"` | none |
///
/// # The grammar of a cell
///
/// | cell | meaning |
/// |---|---|
/// | `0.35`, `-1e-3` | a number in SI units |
/// | `350 mm`, `24 in`, `3.8e6 N*m/rad`, `0.1 lb/in^3` | a number with a unit, converted exactly: products, quotients and powers of `m cm mm um in ft`, `kg g lb`, `s ms`, `rad mrad urad deg arcmin arcsec`, `N kN lbf kip kgf`, `Nm kNm Nmm`, `Pa kPa MPa GPa psi ksi Mpsi` |
/// | `pi/2`, `3*pi/4`, `-90 deg` | an angle, an exact multiple of π; a rounded `1.5708` is refused |
/// | `q`, `q + 90 deg`, `0.2 + q`, `q - pi/2` | where the joint moves: in `theta` or in `d` of a row, once |
/// | `a2`, `k3` | a bare identifier: a link parameter that stays symbolic, one name for one quantity |
///
/// # What is generated
///
/// | item of the module | what it is |
/// |---|---|
/// | `NAME`, `N`, `DH` | the arm's name, its number of joints, its table as written |
/// | `pose`, `jacobian`, … | a function for each output, of `q` (`&[S; N]`, rad, m of a prismatic joint) and where it takes one of the wrench (`&[S; 6]`, N and N·m, base axes, at the tool origin), for any `S: Scalar`; its documentation says shape, units, axes and source |
/// | `all` | several of them in one function, which shares what they have in common |
/// | `pose::given`, … | the kernel: the same of a posture, for those who have its sines and cosines |
/// | `Posture`, `Posture::new(q)` | the sines, cosines and displacements that all of them take |
/// | `pose::OPS`, … | its additions, multiplications, sign changes, divisions, sine-cosine pairs |
/// | `pose::SPARSITY`, … | which of its entries are not structurally zero, `[column][row]` |
/// | `all::All` | what `all` returns |
/// | `at::elbow` | the same functions, figures and `Robot` of a frame or marker at which outputs are asked for: of the arm whose tool is there |
/// | `Parameters` | a field for each symbolic parameter; only where the table has some |
/// | `Constants`, `Constants::new(&parameters)` | what is worked out of the parameters once; every function takes them first |
/// | `Robot` | the arm as a value: `Arm<N>` and `has::Pose<N>`, … for what is written against any arm, `Numeric<N>` where the table has numbers only, `Kernels`, every output by its name from slices; with symbolic parameters it holds `Constants` |
///
/// Of a file whose effects depend on them, functions take behind `q` the `sides` from which the joints came (`&[S; N]`, −1,
/// 0 where it is not known, 1) and the `warming` (`S`, K), each if some effect needs it; `Robot` has them as fields,
/// `Robot::default()` knows neither, and `joints` tells the joint values that readings mean.
///
/// A function that solves for a loaded equilibrium returns `Result<_, Unstable>`. Everything is `no_std`
/// and allocates nothing.
#[proc_macro]
pub fn robot(input: TokenStream) -> TokenStream {
    let root = std::env::var_os("CARGO_MANIFEST_DIR").map(PathBuf::from).unwrap_or_default();
    stiffarm_codegen::expand(input.into(), &root).into()
}
