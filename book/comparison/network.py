"""A small network for the missing velocities, fitted to derivatives.

It is no universal differential equation, which is trained along trajectories as a rule, and says nothing of SciML: none was run, as
SciML needs Julia, which was not at hand.
"""
import numpy as np
from sklearn.neural_network import MLPRegressor
from sklearn.pipeline import make_pipeline
from sklearn.preprocessing import StandardScaler

from logs import nominal
from sparse import EDGE


def fit(logs):
    inner = [slice(round(EDGE / log.step), -round(EDGE / log.step)) for log in logs]
    inputs = np.vstack([log.inputs()[i] for log, i in zip(logs, inner)])
    rates = np.vstack([(log.velocities() - nominal(log))[i] for log, i in zip(logs, inner)])
    scale = rates.std(axis=0)
    network = MLPRegressor(hidden_layer_sizes=(16,), activation="tanh", solver="lbfgs", alpha=1e-3, max_iter=500, random_state=0)
    model = make_pipeline(StandardScaler(), network).fit(inputs, rates / scale)
    return lambda log: nominal(log) + model.predict(log.inputs()) * scale
