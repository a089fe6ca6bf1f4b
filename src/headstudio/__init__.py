"""headstudio: hair that is shaken live, wisps that are styled, wrinkles that deepen as the face moves, on one head."""

import os

# Arrays here are small: threads inside the linear algebra wait for one another longer than they work, and a step of 5,000
# particles takes several times as long. numpy asks when it is imported, which is later; who has said otherwise is obeyed.
for _name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS"):
    os.environ.setdefault(_name, "1")

__version__ = "0.4.0"
