"""The bench: small, for what it says rather than for how fast this machine is."""

import json
from pathlib import Path

import numpy as np
import pytest
from scipy.spatial import cKDTree

from headstudio.bench.neighbours import neighbour_cost, search_both

HEAD = ("--head", "mannequin")


def test_it_prints_a_column_for_each_count_and_writes_all_figures(headstudio, monkeypatch):
    monkeypatch.setenv("COLUMNS", "120")
    ran = headstudio("bench", "--of", "animation", "--counts", "100,150", "--frames", 2, "--json", "bench.json", *HEAD)
    assert ran.status == 0
    for word in ("neighbours, ms", "solve, ms", "picture: light, ms", "frames a second", "6.7", "33 %", "cKDTree"):
        assert word in ran.output
    report = json.loads(Path("bench.json").read_text())
    assert set(report) == {"versions", "renderer", "cores", "paper", "animations"}
    assert [cost["particles"] for cost in report["animations"]] == pytest.approx([100, 150], rel=0.02)
    for cost in report["animations"]:
        assert cost["frames"] == 2
        assert 0 < cost["frame_ms"] < 3 * (cost["simulation_ms"] + cost["picture_ms"])
        assert cost["fps"] == pytest.approx(1000 / cost["frame_ms"])
        assert cost["neighbours"]["steps"] > 0
        assert min(cost["stages"].values()) >= 0


def test_hairstyles_stage_by_stage(headstudio, monkeypatch):
    monkeypatch.setenv("COLUMNS", "120")
    monkeypatch.setattr("headstudio.bench.changes.REPEATS", 1)
    few = ("--strands", "300,600", *(f"--set=wisp.{n}" for n in ("strands=600", "wisps=30", "points=8")))
    ran = headstudio("bench", "--of", "hairstyle", *few, "--json", "bench.json", *HEAD)
    assert ran.status == 0
    for word in ("wisps", "flow", "colour", "settings to strands", "final, 1024 x 1024", "1800000"):
        assert word in ran.output
    report = json.loads(Path("bench.json").read_text())
    costs = report["hairstyles"]
    assert {"colour", "fuzziness", "stroke on the length map", "tie moved", "preset chosen"} <= report["changes"].keys()
    for cost in report["changes"].values():
        assert 0 < cost["build_ms"] < cost["seen_ms"] <= cost["whole_ms"] + 1e-6
    assert [cost["strands"] for cost in costs] == [300, 600]
    for cost in costs:
        assert sum(cost["stages"].values()) == pytest.approx(cost["style_ms"], rel=0.5)
        assert cost["final_ms"] > 0
        assert cost["memory_bytes"] is None or 5e7 < cost["memory_bytes"] < 2e9


def test_a_face_and_its_carving(headstudio, monkeypatch):
    monkeypatch.setenv("COLUMNS", "120")
    ran = headstudio(
        "bench",
        "--of",
        "face",
        "--frames",
        2,
        "--texels",
        "128",
        "--set",
        "fine.texture_size=128",
        "--json",
        "b.json",
        *HEAD,
    )
    assert ran.status == 0
    for word in ("shrinkage, furrows, normals", "frames a second", "two fine fields of 128 x 128"):
        assert word in ran.output
    report = json.loads(Path("b.json").read_text())
    assert report["face"]["fps"] == pytest.approx(1000 / report["face"]["frame_ms"])
    assert report["face"]["refined"] > report["face"]["triangles"]
    assert 15_000 < report["face"]["light_refined"] < 25_000
    assert report["face"]["light_ms"] > 0
    assert report["carvings"][0]["segments"] > 100


def test_it_counts_the_pairs_that_the_tree_finds():
    positions = np.random.default_rng(1).random((400, 3))
    cost = neighbour_cost([search_both(positions, 0.1)], step_ms=0.1, searches=1, steps=10)
    assert cost.pairs == len(cKDTree(positions).query_pairs(0.1))
    assert cost.part_of_kdtree == pytest.approx(0.1 / cost.kdtree_ms)


def test_counts_that_are_no_numbers_are_one_line(headstudio):
    ran = headstudio("bench", "--counts", "many")
    assert ran.status == 2
    assert "whole numbers" in ran.complaint
