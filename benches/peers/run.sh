#!/usr/bin/env bash
# The KUKA KR 240-2 by what one would pick instead of generated kernels, each fed the same joint vectors and
# wrenches, compared with the textbook's results and then timed, all in one run: random poses, a smooth path,
# and random ones where each call waits for the last. CasADi and Pinocchio are given the formulas of what
# they have no function for; Pinocchio also takes K_C from its own second derivatives. What is called all is
# pose, Jacobian, K_C, joint torques, compliance, and the deflection with its 6x6 solve.
#
#   benches/peers/run.sh                 # what is installed
#   benches/peers/run.sh --install       # first from Debian (Orocos KDL) and PyPI (the others)
#
# Then the equations of motion of a UR10 and a Panda, likewise: stiffarm's C beside CasADi's, Pinocchio and the C that
# CppADCodeGen prints of Pinocchio by turns, and stiffarm's Rust beside the crates dynibo and featherstone; and the fit of
# base parameters alone beside Pinocchio's regressor and FIGAROH. At last the inverse kinematics beside the crates ik-geo and
# rs-opw-kinematics, EAIK and the C of roboticstoolbox.
#
# A peer that is not installed is skipped with a sentence. EIGEN is the folder of Eigen's headers. FLAGS and RUSTFLAGS choose the target; the
# default is the machine's own processor for all. Plain x86-64 instead:
#
#   FLAGS=-O3 RUSTFLAGS=-Ctarget-cpu=x86-64 FEATURES= benches/peers/run.sh
set -euo pipefail
cd "$(dirname "$0")"
read -ra flags <<<"${FLAGS:--O3 -march=native}"
export RUSTFLAGS=${RUSTFLAGS:--C target-cpu=native}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
features=${FEATURES-fma}
python=${PYTHON:-python3}
eigen=${EIGEN:-/usr/include/eigen3}

if [ "${1:-}" = --install ]; then
    apt-get install -y --no-install-recommends liborocos-kdl-dev libeigen3-dev g++ cmake
    "$python" -m pip install --quiet casadi pin cmeel-cppad cmeel-cppadcodegen figaroh symforce wrenfold eaik roboticstoolbox-python python-flint
fi

say() { printf '%s\n' "$*" >&2; }

cargo run --quiet --release --manifest-path ../speed/Cargo.toml --bin peers --features "$features" -- "$work" \
    > "$work/times"

if "$python" -c 'import casadi' 2>/dev/null; then
    (cd "$work" && "$python" "$OLDPWD/casadi_peer.py" kernels.c)
    gcc "${flags[@]}" -c "$work/kernels.c" -o "$work/kernels.o"
    g++ -std=c++17 "${flags[@]}" -I. casadi_peer.cpp "$work/kernels.o" -o "$work/casadi"
    "$work/casadi" "$work" >> "$work/times"
else
    say "CasADi is skipped: the Python package casadi is not installed"
fi

# Functions of one's own (examples/program), as C.
"$python" program_peer.py "$work"
cargo run --quiet --release -p stiffarm-program --example c -- "$work"
(
    cd "$work"
    with=()
    [ ! -e program_casadi.c ] || with+=(-DCASADI program_casadi.c)
    [ ! -e program_symforce_clearance.c ] || with+=(-DSYMFORCE program_symforce_*.c)
    if [ -e program_wrenfold_clearance.cpp ]; then
        g++ -std=c++17 "${flags[@]}" -c program_wrenfold_*.cpp
        with+=(-DWRENFOLD program_wrenfold_*.o)
    fi
    gcc "${flags[@]}" -I. "$OLDPWD/program_drive.c" kr240.c "${with[@]}" -lm -o program
)
"$work/program"

if [ -e /usr/include/kdl/chain.hpp ]; then
    g++ -std=c++17 "${flags[@]}" -I. -I"$eigen" kdl_peer.cpp -lorocos-kdl -o "$work/kdl"
    "$work/kdl" "$work" >> "$work/times"
else
    say "Orocos KDL is skipped: liborocos-kdl-dev is not installed"
fi

pinocchio=()
prefix=$("$python" -c 'import sysconfig; print(sysconfig.get_path("purelib") + "/cmeel.prefix")')
if [ -e "$prefix/include/pinocchio/multibody.hpp" ] && [ -e "$eigen" ]; then
    # shellcheck disable=SC2054 # the linker's options have commas of their own
    pinocchio=(-w -DPINOCCHIO -DNDEBUG -DBOOST_MPL_CFG_NO_PREPROCESSED_HEADERS -DBOOST_MPL_LIMIT_LIST_SIZE=30
        -DBOOST_MPL_LIMIT_VECTOR_SIZE=30 -DBOOST_FUSION_INVOKE_MAX_ARITY=12
        -I"$prefix/include" -I"$eigen" -L"$prefix/lib" -Wl,-rpath,"$prefix/lib" -lpinocchio_default)
    g++ -std=c++17 "${flags[@]}" -I. pinocchio_peer.cpp "${pinocchio[@]}" -o "$work/pinocchio"
    "$work/pinocchio" "$work" >> "$work/times"
else
    say "Pinocchio is skipped: the Python package pin or libeigen3-dev is not installed"
fi

if cargo build --quiet --release --manifest-path k/Cargo.toml --target-dir "$work/k" 2> "$work/k.log"; then
    "$work/k/release/k-peer" "$work" >> "$work/times"
else
    say "k is skipped: the crate could not be built; $(tail -n 1 "$work/k.log")"
fi

# Nanoseconds, and how many times that of the fused kernel of one pose.
awk '{ times[$1, $2, $3] = $4; if (!seen[$1]++) peers[++count] = $1 }
     END {
         split("pose jacobian complementary_stiffness deflection_first_order compliance deflection all", outputs)
         split("random smooth random-serial", paths)
         for (o = 1; o <= 7; o++) for (p = 1; p <= 3; p++) {
             own = times["stiffarm-fused", outputs[o], paths[p]]
             if (!own) continue
             printf "%s, %s:", outputs[o], paths[p]
             for (i = 1; i <= count; i++) {
                 time = times[peers[i], outputs[o], paths[p]]
                 if (time) printf "  %s %.1f (%.2f)", peers[i], time, time / own
             }
             print ""
         }
     }' "$work/times"

# The equations of motion. Medians, and of the peers the least, the median and the most over the rounds of how many
# times stiffarm's they are.
cargo run --quiet --release --manifest-path ../speed/Cargo.toml --bin dynamics --features "$features" -- "$work"
(cd "$work" && gcc "${flags[@]}" -c ur10.c panda.c)
with=()
if "$python" -c 'import casadi' 2>/dev/null; then
    "$python" dynamics_peer.py "$work"
    gcc "${flags[@]}" -c "$work/dynamics_casadi.c" -o "$work/dynamics_casadi.o"
    with+=(-DCASADI "$work/dynamics_casadi.o")
fi
if [ ${#pinocchio[@]} -gt 0 ] && [ -e "$prefix/include/cppad/cg.hpp" ]; then
    g++ -std=c++17 -I. dynamics_cppadcg.cpp "${pinocchio[@]}" -lcppad_lib -o "$work/dynamics_cppadcg"
    "$work/dynamics_cppadcg" "$work"
    gcc "${flags[@]}" -c "$work/dynamics_cppadcg.c" -o "$work/dynamics_cppadcg.o"
    with+=(-DCPPADCG "$work/dynamics_cppadcg.o")
else
    say "Pinocchio with CppADCodeGen is skipped: the Python packages cmeel-cppad and cmeel-cppadcodegen are not installed"
fi
g++ -std=c++17 "${flags[@]}" -I. -I"$work" dynamics_drive.cpp "$work/ur10.o" "$work/panda.o" "${with[@]}" \
    "${pinocchio[@]}" -o "$work/dynamics"
"$work/dynamics" "$work"

# The fit of base parameters alone, of the same states and torques.
cargo run --quiet --release --manifest-path ../speed/Cargo.toml --bin base_parameters --features "$features" -- "$work"
if "$python" -c 'import pinocchio' 2>/dev/null; then
    "$python" base_parameters_peer.py "$work"
else
    say "the base parameters of Pinocchio and FIGAROH are skipped: the Python package pin is not installed"
fi

# ik-geo builds NLopt with cmake.
with=()
if command -v cmake > "$work/cmake"; then
    with+=(--features ik-geo)
    # Of NLopt's own build file, for a cmake of today.
    export CMAKE_POLICY_VERSION_MINIMUM=3.5
else
    say "ik-geo is skipped: cmake is not installed"
fi
if cargo build --quiet --release --manifest-path crates/Cargo.toml "${with[@]}" --target-dir "$work/crates" 2> "$work/crates.log"; then
    "$work/crates/release/crates-peer" "$work"
else
    say "dynibo, featherstone, ik-geo and rs-opw-kinematics are skipped: they could not be built; $(tail -n 1 "$work/crates.log")"
fi
"$python" inverse_peers.py "$work"
