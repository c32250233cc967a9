"""Files of other programs' formats, made by their reference libraries, read by jounce to the same bits."""

import wave

import h5py
import numpy as np
import pytest
import scipy.io
from nptdms import ChannelObject, TdmsFile, TdmsWriter

import jounce

TIME = np.arange(400) / 1000.0
TYPES = ("f8", "f4", "i1", "i2", "i4", "i8", "u1", "u2", "u4", "u8")


def samples(kind):
    values = 100.0 * np.sin(40.0 * TIME) + 0.1 * TIME
    return (values + 101.0 if kind.startswith("u") else values).astype(kind)


def read_single(path):
    (recording,) = jounce.read_recordings(path)
    return recording


def assert_identical(actual, expected):
    assert np.array_equal(actual, np.asarray(expected, dtype=np.complex128 if np.iscomplexobj(expected) else np.float64))


@pytest.mark.parametrize("compressed", [False, True])
def test_mat_arrays_structs_and_cells(tmp_path, compressed):
    path = tmp_path / "a.mat"
    cells = np.empty(2, dtype=object)
    cells[:] = [samples("f8"), samples("i2")]
    signal = np.zeros(2, dtype=[("values", object), ("label", object), ("unit", object)])
    signal[0] = (samples("f4"), "tip", "V")
    signal[1] = (samples("i4"), "base", "m/s^2")
    frf = {"f": np.arange(50) * 0.5, "H": np.exp(1j * np.arange(50.0)) * 3.0}
    data = {"time": TIME, "signal": signal, "frf": frf, "cells": cells, "matrix": np.column_stack([samples("f8"), samples("f8") ** 2])}
    scipy.io.savemat(path, {"data": data}, do_compression=compressed)
    over_time, over_frequency = jounce.read_recordings(path)
    back = scipy.io.loadmat(path, squeeze_me=True, struct_as_record=False)["data"]
    # An even grid has its start and its step: its places are those of the file but for roundoff.
    assert np.allclose(over_time.places, back.time, rtol=1e-12, atol=1e-15)
    assert_identical(over_time["tip"], back.signal[0].values)
    assert_identical(over_time["base"], back.signal[1].values)
    assert_identical(over_time["data.cells{2}"], back.cells[1])
    assert_identical(over_time["data.matrix(2)"], back.matrix[:, 1])
    assert [over_time.channel(name).unit for name in ("tip", "base")] == ["V", "m/s^2"]
    assert over_frequency.over == "frequency"
    assert_identical(over_frequency["data.frf.H"], back.frf.H)


@pytest.mark.parametrize("kind", TYPES)
def test_every_type_of_number(tmp_path, kind):
    values = samples(kind)
    scipy.io.savemat(tmp_path / "a.mat", {"t": TIME, "x": values})
    np.savez(tmp_path / "a.npz", t=TIME, x=values)
    np.savez_compressed(tmp_path / "b.npz", t=TIME, x=values.astype(values.dtype.newbyteorder(">")))
    with h5py.File(tmp_path / "a.h5", "w") as file:
        file["t"] = TIME
        file.create_dataset("x", data=values, chunks=(64,), compression="gzip", shuffle=True)
    with TdmsWriter(tmp_path / "a.tdms") as writer:
        properties = {"wf_increment": 1e-3, "wf_start_offset": 0.0}
        for part in (slice(0, 150), slice(150, 400)):
            writer.write_segment([ChannelObject("group", "x", values[part], properties)])
    for name in ("a.mat", "a.npz", "b.npz", "a.h5"):
        recording = read_single(tmp_path / name)
        assert_identical(recording["x"], values)
        assert np.allclose(recording.places, TIME, rtol=1e-12, atol=1e-15)
    recording = read_single(tmp_path / "a.tdms")
    assert_identical(recording["x"], TdmsFile.read(tmp_path / "a.tdms")["group"]["x"][:])
    assert abs(recording.rate - 1000.0) < 1e-9


def test_complex_and_named_arrays_of_numpy(tmp_path):
    response = np.exp(1j * TIME * 30.0)
    np.savez(tmp_path / "a.npz", frequency_hz=np.arange(400) * 0.25, H=response, H_unit="m/s^2/N")
    recording = read_single(tmp_path / "a.npz")
    assert (recording.over, recording.channels[0].unit) == ("frequency", "m/s^2/N")
    assert_identical(recording["H"], response)
    cube = np.arange(400.0 * 6).reshape(400, 2, 3)
    np.savez(tmp_path / "b.npz", t=TIME, cube=cube)
    recording = read_single(tmp_path / "b.npz")
    assert_identical(recording["cube(2,3)"], cube[:, 1, 2])


@pytest.mark.parametrize("libver", ["earliest", ("earliest", "v110")])
def test_hdf5_groups_attributes_and_filters(tmp_path, libver):
    path = tmp_path / "a.h5"
    with h5py.File(path, "w", libver=libver) as file:
        run = file.create_group("run")
        run["time"] = TIME
        tip = run.create_dataset("tip", data=samples("f4"), chunks=(100,), compression="lzf", fletcher32=True)
        tip.attrs["units"] = "V"
        run.create_dataset("both", data=np.column_stack([samples("f8"), samples("f8") * 2]), chunks=(64, 1), compression="gzip")
        run["note"] = "a text"
    recording = read_single(path)
    assert_identical(recording["run.tip"], samples("f4"))
    assert_identical(recording["run.both(2)"], samples("f8") * 2)
    assert recording.channel("run.tip").unit == "V"
    with h5py.File(tmp_path / "b.h5", "w", libver=libver) as file:
        file["x"] = samples("f8")
        file["x"].attrs["fs"] = 500.0
    assert abs(read_single(tmp_path / "b.h5").rate - 500.0) < 1e-9


def test_matlab_73(tmp_path):
    """As MATLAB writes ``save('a.mat', 'data', '-v7.3')``: a block of 512 bytes, turned arrays, references."""
    path = tmp_path / "a.mat"
    with h5py.File(path, "w", userblock_size=512) as file:
        refs = file.create_group("#refs#")

        def numbers(group, name, values):
            dataset = group.create_dataset(name, data=np.atleast_2d(values))
            dataset.attrs["MATLAB_class"] = np.bytes_("double")
            return dataset

        def text(group, name, value):
            dataset = group.create_dataset(name, data=np.array([[ord(c)] for c in value], dtype=np.uint16))
            dataset.attrs["MATLAB_class"] = np.bytes_("char")
            return dataset

        data = file.create_group("data")
        data.attrs["MATLAB_class"] = np.bytes_("struct")
        numbers(data, "time", TIME)
        signal = data.create_group("signal")
        signal.attrs["MATLAB_class"] = np.bytes_("struct")
        fields = {
            "values": [numbers(refs, "a", samples("f8")), numbers(refs, "b", samples("f8") * 3)],
            "label": [text(refs, "c", "tip"), text(refs, "d", "base")],
            "unit": [text(refs, "e", "V"), text(refs, "f", "m/s^2")],
        }
        for name, references in fields.items():
            signal.create_dataset(name, data=np.array([[one.ref] for one in references], dtype=h5py.ref_dtype))
        cell = data.create_dataset("cells", data=np.array([[refs["a"].ref], [refs["b"].ref]], dtype=h5py.ref_dtype))
        cell.attrs["MATLAB_class"] = np.bytes_("cell")
    with open(path, "r+b") as file:
        file.write(b"MATLAB 7.3 MAT-file".ljust(124) + b"\x00\x02IM")
    recording = read_single(path)
    assert_identical(recording["tip"], samples("f8"))
    assert_identical(recording["base"], samples("f8") * 3)
    assert_identical(recording["data.cells{2}"], samples("f8") * 3)
    assert [recording.channel(name).unit for name in ("tip", "base")] == ["V", "m/s^2"]


@pytest.mark.parametrize("width", [1, 2, 4])
def test_wav_of_the_standard_library(tmp_path, width):
    values = samples({1: "u1", 2: "i2", 4: "i4"}[width])
    with wave.open(str(tmp_path / "a.wav"), "wb") as file:
        file.setnchannels(2)
        file.setsampwidth(width)
        file.setframerate(8000)
        file.writeframes(np.repeat(values, 2).tobytes())
    recording = read_single(tmp_path / "a.wav")
    assert abs(recording.rate - 8000.0) < 1e-9 and len(recording.channels) == 2
    assert_identical(recording["channel 2"], values.astype("f8") - (128.0 if width == 1 else 0.0))


@pytest.mark.parametrize("kind", ["i2", "i4", "f4", "f8"])
def test_wav_of_scipy(tmp_path, kind):
    values = np.column_stack([samples(kind), samples(kind)[::-1]])
    scipy.io.wavfile.write(tmp_path / "a.wav", 44100, values)
    rate, back = scipy.io.wavfile.read(tmp_path / "a.wav")
    recording = read_single(tmp_path / "a.wav")
    assert abs(recording.rate - rate) < 1e-6
    assert_identical(recording["channel 1"], back[:, 0])
    assert_identical(recording["channel 2"], back[:, 1])


def test_mode_shapes_of_pyuff(tmp_path):
    pyuff = pytest.importorskip("pyuff")
    path = tmp_path / "a.uff"
    header = {f"id{k}": "NONE" for k in range(1, 6)}
    common = {"type": 55, "model_type": 1, "data_ch": 2, "spec_data_type": 8, "n_data_per_node": 3, "load_case": 1, "mode_n": 1, **header}
    shape = np.arange(9.0).reshape(3, 3)
    normal = {**common, "analysis_type": 2, "data_type": 2, "freq": 12.5, "modal_m": 0.25, "modal_damp_vis": 0.013, "modal_damp_his": 0.0}
    eigenvalue = -3.0 + 80.0j
    complex_shape = shape * (1.0 - 0.5j)
    damped = {**common, "analysis_type": 3, "data_type": 5, "eig": eigenvalue, "modal_a": 1 + 0j, "modal_b": 0j}
    columns = [{"node_nums": np.array([1, 5, 9]), **dict(zip(("r1", "r2", "r3"), of.T))} for of in (shape, complex_shape)]
    pyuff.UFF(str(path)).write_sets([{**normal, **columns[0]}, {**damped, **columns[1]}], mode="overwrite")
    first, second = jounce.read_recordings(path).shapes
    assert (first.frequency_hz, first.damping_ratio, first.modal_mass, first.node.tolist()) == (12.5, 0.013, 0.25, [1, 5, 9])
    assert np.allclose(first.shape, shape, rtol=1e-5) and np.allclose(second.shape, complex_shape, rtol=1e-5)
    assert np.isclose(second.frequency_hz, abs(eigenvalue) / (2 * np.pi)) and np.isclose(second.damping_ratio, 3.0 / abs(eigenvalue))
    assert np.isnan(second.modal_mass)
