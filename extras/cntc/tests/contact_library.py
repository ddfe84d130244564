"""contact_addon_linux64.so by ctypes, with the prototypes of CONTACT's Python interface: all by reference."""
import ctypes
from ctypes import POINTER, c_char_p, c_double, c_int

import numpy as np

UNITS, P, T, N, F, B, INFLUENCE, EXTRA_SLIP, ESTIMATE = 1933, 1970, 1972, 1973, 1974, 1971, 1978, 1980, 1983
MM, SIMPACK, SI = 1934, 1935, 1936

# i: int by reference or array; d: double by reference or array; s: text.
PROTOTYPES = {
    "cntc_initializefirst": "iiisssiii", "cntc_initializefirst_new": "iiisssiii", "cntc_initialize": "iiiisi",
    "cntc_setfileunits": "ii", "cntc_getmaxnumthreads": "i",
    "cntc_readinpfile": "iisii", "cntc_setglobalflags": "iii", "cntc_setflags": "iiiii", "cntc_setmetadata": "iiiid",
    "cntc_setsolverflags": "iiiiiid", "cntc_setmaterialparameters": "iiiid", "cntc_settemperaturedata": "iiiid",
    "cntc_settimestep": "iid", "cntc_setreferencevelocity": "iid", "cntc_setrollingstepsize": "iidd",
    "cntc_setfrictionmethod": "iiiid", "cntc_sethertzcontact": "iiiid", "cntc_setpotcontact": "iiiid",
    "cntc_setverticalforce": "id", "cntc_setpenetration": "iid", "cntc_setnormalforce": "iid",
    "cntc_setundeformeddistc": "iiiid", "cntc_setcreepages": "iiddd", "cntc_setextrarigidslip": "iiidd",
    "cntc_settangentialforces": "iidd", "cntc_settrackdimensions": "iiid", "cntc_setprofileinputfname": "isiiiid",
    "cntc_setprofileinputvalues": "iidiiid", "cntc_setwheelsetdimensions": "iiid", "cntc_setwheelsetposition": "iiid",
    "cntc_setwheelsetvelocity": "iiid", "cntc_setwheelsetflexibility": "iiid", "subs_addblock": "iiiiiiiddd",
    "cntc_calculate": "iii", "subs_calculate": "iii", "cntc_getflags": "iiiii", "cntc_getparameters": "iiiid",
    "cntc_getprofilevalues": "iiiiidid", "cntc_getprofilevalues_new": "iiiiidid", "cntc_getwheelsetposition": "iid",
    "cntc_getwheelsetvelocity": "iid", "cntc_getnumcontactpatches": "ii", "cntc_getcontactlocation": "iiid",
    "cntc_getreferencevelocity": "iid", "cntc_gethertzcontact": "iiid", "cntc_getnumelements": "iiii",
    "cntc_getgriddiscretization": "iidd", "cntc_getpotcontact": "iiid", "cntc_getpenetration": "iid",
    "cntc_getcreepages": "iiddd", "cntc_getcontactforces": "iidddd", "cntc_getglobalforces": "iiid",
    "cntc_getcontactpatchareas": "iiddd", "cntc_getelementdivision": "iiii", "cntc_getmaximumpressure": "iid",
    "cntc_getmaximumtraction": "iid", "cntc_getmaximumtemperature": "iidd", "cntc_getfielddata": "iiiid",
    "cntc_gettractions": "iiiddd", "cntc_getmicroslip": "iiidd", "cntc_getdisplacements": "iiiddd",
    "cntc_getsensitivities": "iiiid", "cntc_getcalculationtime": "iidd", "cntc_resetcalculationtime": "ii",
    "subs_getblocksize": "iiiiii", "subs_getresults": "iiiiiid", "cntc_finalize": "i", "cntc_finalizelast": "",
    "rscntc_setlayers": "iiiiddd", "rscntc_lasterror": "iiisi",
}
TYPES = {"i": POINTER(c_int), "d": POINTER(c_double), "s": c_char_p}


def load(path):
    library = ctypes.CDLL(path)
    for name, arguments in PROTOTYPES.items():
        function = getattr(library, name)
        function.restype = None
        function.argtypes = [TYPES[letter] for letter in arguments]
    return library


def begin(library, folder=None, output=-1, name=b" "):
    """Without a file of messages unless there is a folder for it."""
    version, error, text = c_int(), c_int(77), str(folder or " ").encode()
    library.cntc_finalizelast()
    library.cntc_initializefirst(version, error, c_int(output), b" ", text, name, c_int(1), c_int(len(text)),
                                 c_int(len(name)))
    assert version.value == 2510 and error.value == 0


class Contact:
    """One contact problem. Settings take plain numbers and lists."""

    def __init__(self, library, ire=1, icp=1, units=MM):
        self.library, self.ire, self.icp = library, ire, icp
        self.flag(UNITS, units)

    def call(self, name, *arguments):
        function = getattr(self.library, name)
        ready = []
        for value, letter in zip((self.ire, self.icp, *arguments), PROTOTYPES[name]):
            kind = {"i": c_int, "d": c_double}[letter]
            if isinstance(value, np.ndarray):
                ready.append(value.ctypes.data_as(POINTER(kind)))
            elif isinstance(value, (list, tuple)):
                ready.append((kind * max(1, len(value)))(*value))
            else:
                ready.append(value if isinstance(value, ctypes._SimpleCData) else kind(value))
        return function(*ready)

    def flag(self, *pairs):
        self.call("cntc_setflags", len(pairs) // 2, list(pairs[::2]), list(pairs[1::2]))

    def flags(self, **values):
        names = {"P": P, "T": T, "N": N, "F": F, "B": B, "I": ESTIMATE, "C": INFLUENCE, "E": EXTRA_SLIP}
        for name, value in values.items():
            self.flag(names[name], value)

    def set(self, name, number, values):
        self.call(name, number, len(values), [float(v) for v in values])

    def materials(self, nu1, nu2, g1, g2):
        self.set("cntc_setmaterialparameters", 0, [nu1, nu2, g1, g2])

    def friction(self, f):
        self.set("cntc_setfrictionmethod", 0, [f, f])

    def hertz(self, ipotcn, values):
        self.set("cntc_sethertzcontact", ipotcn, values)

    def hertz_results(self):
        """A1, B1, AA, BB, RHO, CP."""
        out = np.zeros(6)
        self.call("cntc_gethertzcontact", 6, out)
        return out

    def grid(self, ipotcn, values):
        self.set("cntc_setpotcontact", ipotcn, values)

    def gap(self, ibase, values):
        self.set("cntc_setundeformeddistc", ibase, values)

    def calculate(self):
        error = c_int(77)
        self.call("cntc_calculate", error)
        return error.value

    def error(self):
        code, out = c_int(), ctypes.create_string_buffer(2000)
        self.library.rscntc_lasterror(c_int(self.ire), c_int(self.icp), code, out, c_int(len(out)))
        return code.value, out.value.decode()

    def numbers(self, name, count):
        out = [c_double() for _ in range(count)]
        self.call(name, *out)
        return [v.value for v in out]

    def forces(self):
        return self.numbers("cntc_getcontactforces", 4)

    def creepages(self):
        return self.numbers("cntc_getcreepages", 3)

    def approach(self):
        return self.numbers("cntc_getpenetration", 1)[0]

    def p_max(self):
        return self.numbers("cntc_getmaximumpressure", 1)[0]

    def tau_max(self):
        return self.numbers("cntc_getmaximumtraction", 1)[0]

    def size(self):
        mx, my = c_int(), c_int()
        self.call("cntc_getnumelements", mx, my)
        return mx.value, my.value

    def division(self):
        mx, my = self.size()
        out = np.zeros(mx * my, dtype=np.int32)
        self.call("cntc_getelementdivision", mx * my, out)
        return out.reshape(my, mx)

    def field(self, number):
        mx, my = self.size()
        out = np.zeros(mx * my)
        self.call("cntc_getfielddata", number, mx * my, out)
        return out.reshape(my, mx)

    def counts(self):
        """Elements in contact, in slip."""
        division = self.division()
        return int((division > 0).sum()), int((division == 2).sum())

    def block(self, isubs, x, y, z, number=1):
        self.call("subs_addblock", number, isubs, len(x), len(y), len(z), [float(v) for v in x],
                  [float(v) for v in y], [float(v) for v in z])

    def stresses(self, number=1):
        """Columns 1 to 21 of a block, (columns, z, y, x)."""
        error, size = c_int(77), [c_int(), c_int(), c_int()]
        self.call("subs_calculate", error)
        assert error.value == 0, self.error()
        self.call("subs_getblocksize", number, *size)
        nx, ny, nz = (s.value for s in size)
        out = np.zeros((21, nz, ny, nx))
        self.call("subs_getresults", number, nx * ny * nz, 21, list(range(1, 22)), out)
        return out


class Wheel(Contact):
    """A result element of module 1."""

    def __init__(self, library, ire=1, units=MM):
        self.library, self.ire, self.icp = library, ire, -1
        library.cntc_finalize(c_int(ire))
        version, error = c_int(), c_int()
        library.cntc_initialize(c_int(ire), c_int(1), version, error, b" ", c_int(1))
        self.flag(UNITS, units)

    def wheel(self, name, digit, values):
        getattr(self.library, name)(c_int(self.ire), c_int(digit), c_int(len(values)),
                           (c_double * max(1, len(values)))(*values))

    def profile(self, file, kind, mirror_y, mirror_z, scale, smooth, spline=0, kinks=()):
        """kinks: largest share of points left out, ZIGTHRS, KINKHIGH, KINKLOW, KINKWID."""
        values = [scale, smooth, *kinks]
        ints, reals = (c_int * 6)(kind, 0, mirror_y, mirror_z, 0, spline), (c_double * len(values))(*values)
        name = str(file).encode()
        self.library.cntc_setprofileinputfname(c_int(self.ire), name, c_int(len(name)), c_int(6), ints,
                                               c_int(len(values)), reals)

    def profile_values(self, points, kind, scale=1.0, smooth=0.0, spline=0):
        flat = [float(v) for point in points for v in point]
        self.library.cntc_setprofileinputvalues(c_int(self.ire), c_int(len(points)), (c_double * len(flat))(*flat),
                                                c_int(6), (c_int * 6)(kind, 0, 0, 0, 0, spline), c_int(2),
                                                (c_double * 2)(scale, smooth))

    def load(self, force):
        self.library.cntc_setverticalforce(c_int(self.ire), c_double(force))

    def patches(self):
        count = c_int()
        self.library.cntc_getnumcontactpatches(c_int(self.ire), count)
        return count.value

    def patch(self, number):
        out = Contact.__new__(Contact)
        out.library, out.ire, out.icp = self.library, self.ire, number
        return out

    def list_of(self, name, icp, count):
        out = (c_double * count)()
        getattr(self.library, name)(c_int(self.ire), c_int(icp), c_int(count), out)
        return list(out)

    def location(self, icp, count=38):
        return self.list_of("cntc_getcontactlocation", icp, count)

    def global_forces(self, icp=-1):
        return self.list_of("cntc_getglobalforces", icp, 24)

    def list_of_wheel(self, name, count):
        out = (c_double * count)()
        getattr(self.library, name)(c_int(self.ire), c_int(count), out)
        return list(out)
