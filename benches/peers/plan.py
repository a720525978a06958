"""Planning for a car with trailers: `creepage plan` beside direct multiple shooting in CasADi with IPOPT, in turn on one core.

The same vehicle (a rear axle that creeps sideways), goal, limits of inputs and of their rates, rest at both ends, duration free, and
as many shooting intervals. CasADi has piecewise linear inputs and Runge-Kutta steps of order four between the nodes, its usual first guess
(a straight line) and exact second derivatives. Both are timed as a user has them: reading the problem, building, solving.

    python3 benches/peers/plan.py target/release/creepage
"""

import json
import os
import statistics
import subprocess
import sys
import tempfile
import time

CREEP, RADIUS, BASE, LENGTH = 0.03, 0.3, 2.0, 1.5
INTERVALS = 24
GOALS = {1: (12.0, 3.0, 0.3), 3: (15.0, 4.0, 0.3), 10: (25.0, 6.0, 0.3)}
SPEED, STEERING = 1.0, 0.6


def model(trailers):
    lengths = ", ".join([str(LENGTH)]*trailers)
    hitches = ", ".join(["0.0"]*trailers)
    return (f'vehicle = "n-trailer"\ntractor = "car"\n[parameters]\nwheel_radius = {RADIUS}\nwheelbase = {BASE}\n'
            f"trailer_lengths = [{lengths}]\nhitch_offsets = [{hitches}]\n[[effects]]\nid = \"traverse-creep\"\ne_tc = {CREEP}\n")


def creepage(program, folder, trailers):
    path = os.path.join(folder, f"train{trailers}.toml")
    with open(path, "w") as f:
        f.write(model(trailers))
    x, y, heading = GOALS[trailers]
    begin = time.perf_counter()
    out = subprocess.run([program, "plan", path, "--goal", f"{x},{y},{heading}", "--pieces", str(INTERVALS), "--threads", "1",
                          "--out", os.path.join(folder, "plan.csv"), "--format", "json"], capture_output=True, text=True)
    elapsed = time.perf_counter() - begin
    report = json.loads(out.stdout)
    return elapsed, report["duration_s"], report["reached"]["miss_m"]


def casadi(trailers):
    import casadi as ca

    begin = time.perf_counter()
    z = ca.SX.sym("z", 3 + trailers)
    u = ca.SX.sym("u", 2)
    along, across = RADIUS*u[0], CREEP*RADIUS*u[0]
    rates = [along*ca.cos(z[2]) - across*ca.sin(z[2]), along*ca.sin(z[2]) + across*ca.cos(z[2]),
             along/BASE*(ca.tan(u[1]) - CREEP)]
    for i in range(trailers):
        bend = z[2 + i] - z[3 + i]
        rates.append((along*ca.sin(bend) + across*ca.cos(bend))/LENGTH)
        along, across = along*ca.cos(bend) - across*ca.sin(bend), 0.0
    f = ca.Function("f", [z, u], [ca.vertcat(*rates)])
    opti = ca.Opti()
    states, inputs, total = opti.variable(3 + trailers, INTERVALS + 1), opti.variable(2, INTERVALS + 1), opti.variable()
    dt = total/INTERVALS
    steps = 4
    for k in range(INTERVALS):
        at = states[:, k]
        for s in range(steps):
            def held(share, k=k, s=s):
                share = (s + share)/steps
                return (1 - share)*inputs[:, k] + share*inputs[:, k + 1]
            h = dt/steps
            k1 = f(at, held(0))
            k2 = f(at + h/2*k1, held(0.5))
            k3 = f(at + h/2*k2, held(0.5))
            k4 = f(at + h*k3, held(1))
            at = at + h/6*(k1 + 2*k2 + 2*k3 + k4)
        opti.subject_to(states[:, k + 1] == at)
        for c, most in enumerate((SPEED/RADIUS, 2*STEERING)):
            opti.subject_to(opti.bounded(-most*dt, inputs[c, k + 1] - inputs[c, k], most*dt))
    opti.subject_to(opti.bounded(-SPEED/RADIUS, inputs[0, :], SPEED/RADIUS))
    opti.subject_to(opti.bounded(-STEERING, inputs[1, :], STEERING))
    opti.subject_to(states[:, 0] == 0)
    opti.subject_to(inputs[0, 0] == 0)
    opti.subject_to(inputs[0, INTERVALS] == 0)
    goal = GOALS[trailers]
    opti.subject_to(states[0, INTERVALS] == goal[0])
    opti.subject_to(states[1, INTERVALS] == goal[1])
    opti.subject_to(states[2, INTERVALS] == goal[2])
    for i in range(trailers):
        opti.subject_to(opti.bounded(-1.4, states[2 + i, :] - states[3 + i, :], 1.4))
    opti.subject_to(total >= 1)
    steps_of_inputs = inputs[:, 1:] - inputs[:, :-1]
    opti.minimize(total + 0.1*ca.sumsqr(inputs[0, :]*RADIUS/SPEED) + 0.1*ca.sumsqr(inputs[1, :]/STEERING)
                  + 0.1*ca.sumsqr(steps_of_inputs))
    usual = 2.5*goal[0]
    opti.set_initial(total, usual)
    for k in range(INTERVALS + 1):
        opti.set_initial(states[:, k], ca.DM([goal[0]*k/INTERVALS, goal[1]*k/INTERVALS] + [0.0]*(1 + trailers)))
    opti.set_initial(inputs[0, :], SPEED/RADIUS/2)
    opti.solver("ipopt", {"print_time": False}, {"print_level": 0, "sb": "yes", "max_iter": 500})
    solved = opti.solve()
    return time.perf_counter() - begin, float(solved.value(total)), 0.0


def main():
    program = sys.argv[1]
    print("| trailers | creepage plan | CasADi and IPOPT | times faster (median of pairs) | durations of the plans |")
    print("|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        for trailers in GOALS:
            pairs = []
            for _ in range(7):
                own = creepage(program, folder, trailers)
                try:
                    peer = casadi(trailers)
                except RuntimeError as e:
                    print(f"| {trailers} | {own[0]:.2f} s | no plan: {str(e)[:60]} | | {own[1]:.1f} s |")
                    break
                pairs.append((own, peer))
            if pairs:
                own, peer = (statistics.median(p[i][0] for p in pairs) for i in (0, 1))
                ratio = statistics.median(p[1][0]/p[0][0] for p in pairs)
                print(f"| {trailers} | {own:.2f} s | {peer:.2f} s | {ratio:.2f} | {pairs[0][0][1]:.1f} s, {pairs[0][1][1]:.1f} s |")


if __name__ == "__main__":
    main()
